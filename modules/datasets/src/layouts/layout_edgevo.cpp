// SPDX-License-Identifier: BSD-3-Clause
// `edgevo` layout: images/, times.txt, camera.txt, groundtruth_tum.txt.
#include <filesystem>

#include "assumed_camera.h"
#include "edgevo/core/error.h"
#include "layout.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

bool is_edgevo_layout(const std::string& folder) {
  std::error_code ignored;
  return fs::is_directory(fs::path(folder) / "images", ignored);
}

Sequence read_edgevo_layout(const SourceOptions& options) {
  const fs::path root = options.path;
  const std::string images = (root / "images").string(), times = (root / "times.txt").string();
  Sequence sequence;
  sequence.kind = "edgevo folder";
  sequence.images = list_images(images);
  if (existing(times).empty())
    throw InputError(
        times, "is missing",
        "write one line of seconds for each image, or give " + images + " with --camera and --fps");
  sequence.times = read_times(times, &sequence.details);
  check_counts(sequence.images, sequence.times, times, images);
  sequence.camera = choose_or_assume_camera(options, (root / "camera.txt").string(),
                                            {sequence.images.front()}, &sequence.details);
  sequence.ground_truth_path = existing((root / "groundtruth_tum.txt").string());
  return sequence;
}

}  // namespace

Layout edgevo_layout() { return {is_edgevo_layout, read_edgevo_layout, false, nullptr}; }

}  // namespace edgevo
