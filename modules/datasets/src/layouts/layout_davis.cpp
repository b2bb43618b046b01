// SPDX-License-Identifier: BSD-3-Clause
// Event-camera data set of the DAVIS 240C: images.txt (`time file` a line), images/, calib.txt (`fx fy cx cy
// k1 k2 p1 p2 k3`), groundtruth.txt (as TUM's). The events are not read.
#include <filesystem>

#include "assumed_camera.h"
#include "layout.h"
#include "text_file.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// A folder of ours has times.txt; an images.txt of COLMAP has ten fields a line.
bool is_davis_layout(const std::string& folder) {
  const fs::path root = folder;
  const std::string list = existing((root / "images.txt").string());
  if (list.empty() || !existing((root / "times.txt").string()).empty()) return false;
  const auto lines = split_lines(read_text_file(list), list);
  return !lines.empty() && split_fields(lines.front().text).size() == 2;
}

Sequence read_davis_layout(const SourceOptions& options) {
  const fs::path root = options.path;
  Sequence sequence;
  sequence.kind = "DAVIS";
  read_times_and_names(options, "images.txt", &sequence);
  sequence.camera = choose_or_assume_camera(options, (root / "calib.txt").string(),
                                            seen_images(sequence.images), &sequence.decisions);
  sequence.ground_truth_path = existing((root / "groundtruth.txt").string());
  return sequence;
}

}  // namespace

Layout davis_layout() { return {is_davis_layout, read_davis_layout, false, nullptr}; }

}  // namespace edgevo
