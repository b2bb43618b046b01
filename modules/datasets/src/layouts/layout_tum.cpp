// SPDX-License-Identifier: BSD-3-Clause
// TUM RGB-D: rgb.txt (`time file` a line), rgb/, groundtruth.txt; the cameras' calibrations are published on
// its page.
#include <filesystem>

#include "assumed_camera.h"
#include "edgevo/core/error.h"
#include "layout.h"
#include "text_file.h"
#include "time_unit.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

struct Published {
  const char* name;
  Camera camera;
};

// "Intrinsic Camera Calibration of the Kinect" of the dataset's page; freiburg3 is rectified.
const Published kPublished[] = {
    {"freiburg1",
     {{517.306408, 516.469215, 318.643040, 255.313989, 640, 480},
      {0.262383, -0.953104, -0.005358, 0.002628, 1.163314}}},
    {"freiburg2",
     {{520.908620, 521.007327, 325.141442, 249.701764, 640, 480},
      {0.231222, -0.784899, -0.003257, -0.000105, 0.917205}}},
    {"freiburg3", {{535.4, 539.2, 320.1, 247.6, 640, 480}, {}}},
};

Camera tum_camera(const SourceOptions& options, Sequence* sequence) {
  const SeenImages images = seen_images(sequence->images);
  if (!options.camera_file.empty())
    return camera_of_file(camera_file_of(options, ""), images, &sequence->decisions);
  const std::string folder = fs::path(fs::weakly_canonical(options.path)).filename().string();
  for (const Published& published : kPublished) {
    if (folder.find(published.name) == std::string::npos) continue;
    sequence->details.emplace_back("calibration", std::string("published for ") + published.name);
    return published.camera;
  }
  if (options.fov_deg || options.any_camera)
    return choose_or_assume_camera(options, "", images, &sequence->decisions);
  throw InputError(options.path, "the folder's name holds none of freiburg1, freiburg2, freiburg3",
                   "give the camera's file with --camera");
}

bool is_tum_layout(const std::string& folder) {
  return !existing((fs::path(folder) / "rgb.txt").string()).empty();
}

Sequence read_tum_layout(const SourceOptions& options) {
  const fs::path root = options.path;
  Sequence sequence;
  sequence.kind = "TUM RGB-D";
  read_times_and_names(options, "rgb.txt", &sequence);
  sequence.camera = tum_camera(options, &sequence);
  sequence.ground_truth_path = existing((root / "groundtruth.txt").string());
  return sequence;
}

}  // namespace

void read_times_and_names(const SourceOptions& options, const std::string& name, Sequence* sequence) {
  const fs::path root = options.path;
  const std::string list = (root / name).string();
  std::vector<TextLine> times;
  for (const TextLine& line : split_lines(read_text_file(list), list)) {
    const auto fields = split_fields(line.text);
    Timestamp is_number;
    if (fields.size() != 2 || !parse_time(fields[0], kAnyUnit, &is_number))
      throw InputError(line.where, "is not a time and a file name", "restore " + name);
    times.push_back({fields[0], line.where});
    sequence->images.push_back((root / fields[1]).string());
  }
  sequence->times = parse_times_of(times, options, &sequence->decisions);
  if (sequence->images.empty()) throw InputError(list, "names no images", "restore " + name);
}

Layout tum_layout() { return {is_tum_layout, read_tum_layout, false, nullptr}; }

}  // namespace edgevo
