// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// All metrics of an estimated trajectory against ground truth as one value, and as a table or JSON.
//
//   const TrajectoryEvaluation e = evaluate(read_trajectory(est), read_trajectory(gt), {});
//   std::cout << to_table(e);
//
// Positions of the estimate may be in any unit; every figure states its alignment or scale. Figures that
// do not exist for a sequence (KITTI's t_rel under 100 m) are absent: "-" in the table, null in JSON.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/evaluation/absolute_error.h"
#include "edgevo/evaluation/relative_error.h"
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

/// Coverage of the input frames by poses; completion, failure and late start add up to 100 percent.
struct Coverage {
  /// Number of input frames.
  int input_frames = 0;
  /// How the input frames were found.
  std::string source;
  /// Number of input frames with a pose.
  int with_pose = 0;
  /// Late start: number of input frames before the first one with a pose.
  int before_first_pose = 0;
  /// Number of input frames without a pose after the first one with a pose.
  int lost = 0;
  /// with_pose / input_frames, percent.
  double completion_percent = 0;
  /// lost / input_frames, percent: the failure rate of one trial in the paper.
  double failure_percent = 0;
};

/// A trajectory file as named in the report.
struct TrajectoryFacts {
  /// Path of the file.
  std::string path;
  /// Format: "TUM" or "KITTI".
  std::string format;
  /// Number of poses in the file.
  int poses = 0;
};

/// All figures of one trajectory.
struct TrajectoryEvaluation {
  /// Files of the estimate and of the ground truth.
  TrajectoryFacts estimate, ground_truth;
  /// Number of estimated poses with ground truth at their time.
  int matched = 0;
  /// Number of estimated poses without ground truth at their time.
  int without_ground_truth = 0;
  /// Block length of ate_blocks, input frames.
  int block_frames = 200;
  /// Coverage of the input frames.
  Coverage coverage;
  /// ATE after a Sim(3) fit, after an SE(3) fit, and ATE200 (absolute_error.h).
  AbsoluteError ate_sim3, ate_se3, ate_blocks;
  /// Drift; nullopt if no interval fits.
  std::optional<Drift> drift;
  /// KITTI figures; nullopt for a path under 100 m.
  std::optional<KittiRelative> kitti;
  /// Length of a window of scale_curve, input frames.
  int scale_window_frames = 0;
  /// Local scale, estimate over ground truth, relative to the whole run.
  std::vector<ScalePoint> scale_curve;
};

/// Computes all figures. Throws InputError for fewer than three matches, a trajectory whose positions all
/// coincide, or a KITTI file (which has no times) against a TUM file with a different number of poses.
/// Deterministic; cost: linear in the poses, times the number of interval lengths.
TrajectoryEvaluation evaluate(const Trajectory& estimate, const Trajectory& ground_truth,
                              const EvaluationOptions& options);

/// Evaluation as aligned text: alignment, number of poses or intervals, value and unit of each figure.
std::string to_table(const TrajectoryEvaluation& evaluation);

/// A member of a JSON object.
struct JsonMember {
  /// Its name.
  std::string name;
  /// Its value, as JSON.
  std::string value;
};
/// Evaluation as one JSON object, indented by two spaces; `more` are its last members.
std::string to_json(const TrajectoryEvaluation& evaluation, const std::vector<JsonMember>& more = {});

}  // namespace edgevo
