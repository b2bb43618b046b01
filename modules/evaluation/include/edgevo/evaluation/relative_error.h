// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Relative errors over intervals of the path: drift, KITTI's t_rel and r_rel, and the curve of the local
// scale.
//
// Over an interval from frame i to j the relative motions of ground truth and estimate are compared:
//   E = (T_est_i^-1 T_est_j)^-1 (T_gt_i^-1 T_gt_j)
// |trans(E)| is the translation error, the angle of E the rotation error. No alignment is needed, only a
// scale.
#include <optional>
#include <vector>

#include "edgevo/evaluation/time_matching.h"

namespace edgevo {

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

/// Drift of `metric_matches`, which are TimeMatches::matches with T_est in metres (rescale_blocks()), over
/// `frames`, which are TimeMatches::frames; nullopt if no interval fits, for instance if the camera never
/// moves. Cost: frames times lengths.
std::optional<Drift> drift(const std::vector<EvaluatedFrame>& frames,
                           const std::vector<MatchedPose>& metric_matches, double cap_cm_per_m);

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

/// KITTI figures of `matches` after multiplying the estimate by `scale`, from one Sim(3) fit of the whole
/// run; nullopt if no interval fits (a path under 100 m).
std::optional<KittiRelative> kitti_relative(const std::vector<EvaluatedFrame>& frames,
                                            const std::vector<MatchedPose>& matches, double scale);

/// Local scale of a window of input frames. Windows overlap by half.
struct ScalePoint {
  /// Input frames of the window's first and last pose.
  int first_frame = 0, last_frame = 0;
  /// Scale (estimate over ground truth) divided by that of the whole run: 1 means no drift.
  double relative_scale = 1;
};

/// Local scale in windows of `window_frames` input frames (interval_scale() of absolute_error.h); windows
/// with fewer than three poses or without motion are skipped. `whole_scale` is ground truth over estimate of
/// the whole run.
std::vector<ScalePoint> scale_curve(const std::vector<MatchedPose>& matches, int window_frames,
                                    double whole_scale);

}  // namespace edgevo
