// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edgevo.h"

#include "edgevo/evaluation/evaluate.h"

namespace edgevo {

TrajectoryEvaluation evaluate(const Run& run, const std::string& ground_truth) {
  EvaluationOptions options;
  options.frames_total = int(run.frames.size());
  return evaluate(trajectory_of(run), read_trajectory(ground_truth), options);
}

}  // namespace edgevo
