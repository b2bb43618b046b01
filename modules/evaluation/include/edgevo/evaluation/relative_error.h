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

#include "edgevo/evaluation/figures.h"
#include "edgevo/evaluation/time_matching.h"

namespace edgevo {

/// Drift of `metric_matches`, which are TimeMatches::matches with T_est in metres (rescale_blocks()), over
/// `frames`, which are TimeMatches::frames; nullopt if no interval fits, for instance if the camera never
/// moves. Cost: frames times lengths.
std::optional<Drift> drift(const std::vector<EvaluatedFrame>& frames,
                           const std::vector<MatchedPose>& metric_matches, double cap_cm_per_m);

/// KITTI figures of `matches` after multiplying the estimate by `scale`, from one Sim(3) fit of the whole
/// run; nullopt if no interval fits (a path under 100 m).
std::optional<KittiRelative> kitti_relative(const std::vector<EvaluatedFrame>& frames,
                                            const std::vector<MatchedPose>& matches, double scale);

/// Local scale in windows of `window_frames` input frames (interval_scale() of absolute_error.h); windows
/// with fewer than three poses or without motion are skipped. `whole_scale` is ground truth over estimate of
/// the whole run.
std::vector<ScalePoint> scale_curve(const std::vector<MatchedPose>& matches, int window_frames,
                                    double whole_scale);

}  // namespace edgevo
