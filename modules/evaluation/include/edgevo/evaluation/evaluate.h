// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All metrics of an estimated trajectory against ground truth as one value (figures.h).
//
//   const TrajectoryEvaluation e = evaluate(read_trajectory(est), read_trajectory(gt), {});
//   std::cout << to_table(e);
#include <optional>

#include "edgevo/evaluation/figures.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// Options of evaluate(); the defaults are those of the paper.
struct EvaluationOptions {
  /// Number of input frames, if given by the user (find_input_frames()).
  std::optional<int> frames_total;
  /// Block length of ATE200, input frames.
  int rescale_block_frames = 200;
  /// Maximum drift that an interval counts, cm/m (relative_error.h).
  double drift_cap_cm_per_m = 30;
};

/// Computes all figures. Throws InputError for fewer than three matches, a trajectory whose positions all
/// coincide, or a KITTI file (which has no times) against a TUM file with a different number of poses.
/// Deterministic; cost: linear in the poses, times the number of interval lengths.
TrajectoryEvaluation evaluate(const Trajectory& estimate, const Trajectory& ground_truth,
                              const EvaluationOptions& options);

}  // namespace edgevo
