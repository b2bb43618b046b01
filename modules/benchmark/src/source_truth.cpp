// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/source_truth.h"

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/datasets/source_folder.h"

namespace edgevo {
namespace {

// The remark of the source on its ground truth, if there is one.
std::string remark_of(const ImageSource& source) {
  for (const auto& [name, value] : source.details())
    if (name == "ground truth") return value;
  return "it has no ground truth";
}

}  // namespace

// For ground truth that is in no trajectory file, `path` of the result describes where it comes from.
Trajectory source_truth(const std::string& path) {
  SourceOptions options;
  options.path = source_folder(path);
  options.any_camera = true;
  std::error_code ignored;
  if (!std::filesystem::is_directory(options.path, ignored)) return read_trajectory(path);
  const auto source = open_source(options);
  if (const std::string file = source->ground_truth_path(); !file.empty()) return read_trajectory(file);
  const std::string text = ground_truth_tum(options, *source);
  if (text.empty())
    throw InputError(options.path, "holds no ground truth: " + remark_of(*source), "give a trajectory file");
  Trajectory truth = parse_trajectory(text, options.path);
  truth.path = (std::filesystem::path(options.path) / remark_of(*source)).string();
  return truth;
}

}  // namespace edgevo
