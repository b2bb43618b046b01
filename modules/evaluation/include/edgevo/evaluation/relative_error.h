#pragma once
// Relative errors over stretches of the path: drift, KITTI's t_rel and r_rel, and the curve of the local scale.
//
// Over a stretch from frame i to j the relative motions of ground truth and estimate are compared:
//   E = (T_est_i^-1 T_est_j)^-1 (T_gt_i^-1 T_gt_j)
// |trans(E)| is the translation error, the angle of E the rotation error. No alignment is needed, only a scale.
#include <optional>
#include <vector>

#include "edgevo/evaluation/association.h"

namespace edgevo {

/// Translational drift. A stretch begins at every input frame that has ground truth and ends at the first one that is
/// at least the wanted length further along the true path; its drift is the translation error over its true length.
/// Lengths: 100, 200, ..., 800 m; 5, 10, 20, 30 % of the path where the whole path is under 400 m.
/// Each stretch counts at most `cap`, and counts the cap if one of its ends, or half or more of its input frames, lack a
/// pose: losing track must not look better than tracking badly.
struct Drift {
  double mean_cm_per_m = 0, median_cm_per_m = 0;  ///< over all stretches
  int stretches = 0;  ///< that were compared
  int capped = 0;              ///< for the size of their error
  int without_poses = 0;       ///< capped for missing poses
  double path_m = 0;           ///< length of the true path over the input
  std::vector<double> lengths_m;  ///< of the stretches, ascending
  /// The same for each of these lengths alone, in their order.
  struct OfLength {
    double mean_cm_per_m = 0, median_cm_per_m = 0, max_cm_per_m = 0;  ///< over the stretches of this length
    int stretches = 0;  ///< 0: none fits, the figures say nothing
  };
  std::vector<OfLength> by_length;  ///< as lengths_m
};

/// `metric_matches` are Association::matches with T_est in metres (rescale_blocks), `frames` Association::frames.
/// nullopt where no stretch fits, as when the camera never moves. Cost: frames times lengths.
std::optional<Drift> drift(const std::vector<EvaluatedFrame>& frames, const std::vector<MatchedPose>& metric_matches,
                           double cap_cm_per_m);

/// The KITTI odometry benchmark's figures, averaged over stretches of 100, 200, ..., 800 m that begin at every tenth
/// frame; as its devkit, divided by the nominal length. Stretches whose ends lack a pose are left out.
struct KittiRelative {
  double t_rel_percent = 0;  ///< translation error over length
  double r_rel_deg_per_100m = 0;  ///< rotation error over length
  int stretches = 0;  ///< that were averaged
};

/// `scale` multiplies the estimate: one Sim(3) fit for all. nullopt where no stretch fits (a path under 100 m).
std::optional<KittiRelative> kitti_relative(const std::vector<EvaluatedFrame>& frames,
                                            const std::vector<MatchedPose>& matches, double scale);

/// Local scale of a window of input frames: estimate over ground truth, divided by that of the whole run, so that 1 means
/// no drift. Windows overlap by half.
struct ScalePoint {
  int first_frame = 0, last_frame = 0;  ///< input frames of the window's first and last pose
  double relative_scale = 1;  ///< estimate over truth, 1: as in the whole run
};

/// Windows of `window_frames` input frames (stretch_scale of absolute_error.h); windows with fewer than three poses or
/// without motion are left out. `whole_scale` is ground truth over estimate of the whole run.
std::vector<ScalePoint> scale_curve(const std::vector<MatchedPose>& matches, int window_frames, double whole_scale);

}  // namespace edgevo
