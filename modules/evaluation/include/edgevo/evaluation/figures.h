// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The figures of an evaluation as plain values, and as a table or JSON; evaluate.h computes them.
//
// Positions of the estimate may be in any unit; every figure states its alignment or scale. Figures that
// do not exist for a sequence (KITTI's t_rel under 100 m) are absent: "-" in the table, null in JSON.
#include <optional>
#include <string>
#include <vector>

namespace edgevo {

/// Distances from ground truth after alignment, metres.
struct AbsoluteError {
  /// Statistics over the poses, metres.
  double rmse = 0, mean = 0, median = 0, max = 0;
  /// Number of poses compared.
  int poses = 0;
  /// Factor by which the alignment multiplied the estimate.
  double scale = 1;
};

/// Translational drift. An interval starts at each input frame that has ground truth and ends at the first
/// one at least the nominal length further along the true path; its drift is the translation error over its
/// true length. Nominal lengths: 100, 200, ..., 800 m; 5, 10, 20, 30 % of the path if it is shorter than 400
/// m. An interval counts at most the cap, and exactly the cap if one of its ends, or at least half of its
/// input frames, lack a pose: losing track must not score better than tracking badly.
struct Drift {
  /// Mean and median over all intervals, cm/m.
  double mean_cm_per_m = 0, median_cm_per_m = 0;
  /// Number of intervals compared.
  int intervals = 0;
  /// Number of intervals whose error exceeded the cap.
  int capped = 0;
  /// Number of intervals that count the cap for missing poses.
  int without_poses = 0;
  /// Length of the true path over the input, metres.
  double path_m = 0;
  /// Nominal lengths of the intervals, ascending, metres.
  std::vector<double> lengths_m;
  /// Drift over the intervals of one nominal length.
  struct OfLength {
    /// Mean, median and maximum, cm/m.
    double mean_cm_per_m = 0, median_cm_per_m = 0, max_cm_per_m = 0;
    /// Number of intervals of this length; 0: none fits, the figures are meaningless.
    int intervals = 0;
  };
  /// Drift for each length, parallel to lengths_m.
  std::vector<OfLength> by_length;
};

/// Figures of the KITTI odometry benchmark, averaged over intervals of 100, 200, ..., 800 m that start at
/// every tenth frame and divided by the nominal length, as in its devkit. Intervals whose ends lack a pose
/// are skipped.
struct KittiRelative {
  /// Translation error over length, percent.
  double t_rel_percent = 0;
  /// Rotation error over length, degrees per 100 m.
  double r_rel_deg_per_100m = 0;
  /// Number of intervals averaged.
  int intervals = 0;
};

/// Local scale of a window of input frames. Windows overlap by half.
struct ScalePoint {
  /// Input frames of the window's first and last pose.
  int first_frame = 0, last_frame = 0;
  /// Scale (estimate over ground truth) divided by that of the whole run: 1 means no drift.
  double relative_scale = 1;
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
