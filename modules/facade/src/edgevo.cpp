// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edgevo.h"

namespace edgevo {

std::unique_ptr<ImageSource> open_source(const std::string& path) {
  SourceOptions options;
  options.path = path;
  return open_source(options);
}

TrajectoryEvaluation evaluate(const Run& run, const std::string& ground_truth) {
  EvaluationOptions options;
  options.frames_total = int(run.frames.size());
  return evaluate(trajectory_of(run), read_trajectory(ground_truth), options);
}

}  // namespace edgevo
