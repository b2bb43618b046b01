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

/// What may be chosen; the defaults are the paper's.
struct EvaluationOptions {
  std::optional<int> frames_total;      ///< number of input frames, where the user knows better (find_input_frames)
  int rescale_block_frames = 200;       ///< ATE200's block, input frames
  double drift_cap_cm_per_m = 30;  ///< what a stretch counts at most (relative_error.h)
};

/// Which input frames have a pose. completion + failure + the late start make 100 percent.
struct Coverage {
  int input_frames = 0;  ///< number of input frames
  std::string source;                   ///< how the input frames were found
  int with_pose = 0;  ///< of these, in the estimate
  int before_first_pose = 0;            ///< late start: input frames before the first one with a pose
  int lost = 0;                         ///< input frames without a pose after that
  double completion_percent = 0;        ///< with_pose / input_frames
  double failure_percent = 0;           ///< lost / input_frames: the paper's failure rate of one trial
};

/// A trajectory file as the report names it.
struct TrajectoryFacts {
  std::string path;  ///< of the file
  std::string format;  ///< "TUM" or "KITTI"
  int poses = 0;  ///< in the file
};

/// All figures of one trajectory.
struct TrajectoryEvaluation {
  TrajectoryFacts estimate, ground_truth;  ///< the two files
  int matched = 0;                      ///< estimated poses with ground truth at their time
  int without_ground_truth = 0;  ///< estimated poses without
  int block_frames = 200;  ///< of ate_blocks, input frames
  Coverage coverage;  ///< which input frames have a pose
  AbsoluteError ate_sim3, ate_se3, ate_blocks;  ///< after Sim(3), after SE(3), and ATE200 (absolute_error.h)
  std::optional<Drift> drift;  ///< none where no stretch fits
  std::optional<KittiRelative> kitti;  ///< none under 100 m
  int scale_window_frames = 0;  ///< input frames of a window of scale_curve
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
