#pragma once
// All metrics of one estimated trajectory against ground truth in one value, and that value as a table or as JSON.
//
//   const TrajectoryEvaluation e = evaluate(read_trajectory(est), read_trajectory(gt), {});
//   std::cout << to_table(e);
//
// Positions of the estimate may be in any unit; every figure says which alignment or scale it used. Figures that do not
// exist for a sequence (KITTI's t_rel under 100 m) are absent: "-" in the table, null in JSON.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/evaluation/absolute_error.h"
#include "edgevo/evaluation/relative_error.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

struct EvaluationOptions {
  std::optional<int> frames_total;      ///< number of input frames, where the user knows better (find_input_frames)
  int rescale_block_frames = 200;       ///< ATE200's block, input frames
  double drift_cap_cm_per_m = 30;
};

/// Which input frames have a pose. completion + failure + the late start make 100 percent.
struct Coverage {
  int input_frames = 0;
  std::string source;                   ///< how the input frames were found
  int with_pose = 0;
  int before_first_pose = 0;            ///< late start: input frames before the first one with a pose
  int lost = 0;                         ///< input frames without a pose after that
  double completion_percent = 0;        ///< with_pose / input_frames
  double failure_percent = 0;           ///< lost / input_frames: the paper's failure rate of one trial
};

/// A trajectory file as the report names it.
struct TrajectoryFacts {
  std::string path;
  std::string format;
  int poses = 0;
};

struct TrajectoryEvaluation {
  TrajectoryFacts estimate, ground_truth;
  int matched = 0;                      ///< estimated poses with ground truth at their time
  int without_ground_truth = 0;
  int block_frames = 200;
  Coverage coverage;
  AbsoluteError ate_sim3, ate_se3, ate_blocks;
  std::optional<Drift> drift;
  std::optional<KittiRelative> kitti;
  int scale_window_frames = 0;
  std::vector<ScalePoint> scale_curve;  ///< estimate over ground truth, relative to the whole run
};

/// Throws InputError: fewer than three matches, all positions of one side equal, a KITTI file against a TUM file with
/// another number of poses (KITTI files have no times). Deterministic; cost: linear in the poses, times the number of
/// stretch lengths.
TrajectoryEvaluation evaluate(const Trajectory& estimate, const Trajectory& ground_truth,
                              const EvaluationOptions& options);

/// Aligned text: alignment, number of poses or stretches, value and unit of each figure.
std::string to_table(const TrajectoryEvaluation& evaluation);

/// The same numbers as one JSON object, indented by two spaces.
std::string to_json(const TrajectoryEvaluation& evaluation);

}  // namespace edgevo
