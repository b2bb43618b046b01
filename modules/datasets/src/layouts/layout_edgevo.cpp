// SPDX-License-Identifier: BSD-3-Clause
// `edgevo` layout: images/, times.txt, camera.txt, groundtruth_tum.txt.
#include <algorithm>
#include <filesystem>
#include <map>

#include "assumed_camera.h"
#include "edgevo/core/error.h"
#include "image_series.h"
#include "layout.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

bool is_edgevo_layout(const std::string& folder) {
  std::error_code ignored;
  return fs::is_directory(fs::path(folder) / "images", ignored);
}

// DSO's times.txt has `name time [exposure]` a line, where a name is that of an image without its suffix.
bool has_names(const std::vector<TextLine>& lines) {
  return !lines.empty() && std::all_of(lines.begin(), lines.end(), [](const TextLine& line) {
    const size_t fields = split_fields(line.text).size();
    return fields == 2 || fields == 3;
  });
}

// The images that the lines name, in their order; all images of the folder are named.
void read_named_times(const std::vector<TextLine>& lines, const std::string& path,
                      const SourceOptions& options, Sequence* sequence) {
  std::map<std::string, std::string> image_of;
  for (const std::string& image : sequence->images) image_of[fs::path(image).stem().string()] = image;
  std::vector<TextLine> times;
  sequence->images.clear();
  for (const TextLine& line : lines) {
    const auto fields = split_fields(line.text);
    const auto it = image_of.find(fields[0]);
    if (it == image_of.end())
      throw InputError(line.where, "names no image of the folder: " + quote(fields[0]),
                       "write the image's name without its suffix, then its time; or the time alone");
    sequence->images.push_back(it->second);
    times.push_back({fields[1], line.where});
  }
  sequence->times = parse_times_of(times, options, &sequence->decisions);
  sequence->decisions.push_back({"order", "by the names in " + path, "its lines are `name time`", ""});
  if (lines.size() < image_of.size())
    sequence->decisions.back().doubt =
        std::to_string(image_of.size() - lines.size()) + " image(s) have no line there and are skipped.";
}

Sequence read_edgevo_layout(const SourceOptions& options) {
  const fs::path root = options.path;
  const std::string images = (root / "images").string(), times = (root / "times.txt").string();
  Sequence sequence;
  sequence.kind = "edgevo folder";
  sequence.images = list_images(images, options, &sequence.decisions);
  if (existing(times).empty())
    throw InputError(
        times, "is missing",
        "write one line of seconds for each image, or give " + images + " with --camera and --fps");
  if (const auto lines = split_lines(read_text_file(times), times); has_names(lines)) {
    read_named_times(lines, times, options, &sequence);
  } else {
    sequence.times = read_times(times, options, &sequence.decisions);
    check_counts(sequence.images, sequence.times, times, images);
  }
  sequence.camera = choose_or_assume_camera(options, (root / "camera.txt").string(),
                                            seen_images(sequence.images), &sequence.decisions);
  sequence.ground_truth_path = existing((root / "groundtruth_tum.txt").string());
  return sequence;
}

}  // namespace

Layout edgevo_layout() { return {is_edgevo_layout, read_edgevo_layout, false, nullptr, true}; }

}  // namespace edgevo
