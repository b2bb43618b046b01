// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Absolute trajectory error (ATE): distance of each position from ground truth after one alignment.
//
//   ATE Sim(3)   Umeyama with scale (evo_ape -as): for monocular estimates, whose unit is arbitrary
//   ATE SE(3)    Umeyama without scale (evo_ape -a): only for estimates in metres
//   ATE200       of the paper: the scale is re-corrected from ground truth every 200 input frames
//                (rescale_blocks), then SE(3); it shows the local geometry without the drift of the monocular
//                scale
#include <optional>
#include <vector>

#include "edgevo/evaluation/figures.h"
#include "edgevo/evaluation/similarity_fit.h"
#include "edgevo/evaluation/time_matching.h"

namespace edgevo {

/// Estimated positions of `matches` as columns, in the unit of the estimate.
Points estimate_points(const std::vector<MatchedPose>& matches);
/// True positions of `matches` as columns, metres.
Points truth_points(const std::vector<MatchedPose>& matches);

/// ATE after a Sim(3) fit; nullopt if there is no fit (similarity_fit.h).
std::optional<AbsoluteError> ate_sim3(const std::vector<MatchedPose>& matches);
/// ATE after an SE(3) fit, for an estimate in metres; nullopt if there is no fit.
std::optional<AbsoluteError> ate_se3(const std::vector<MatchedPose>& matches);

/// `matches` with T_est converted to metres in blocks of `block_frames` consecutive INPUT frames: each step
/// from one pose to the next is multiplied by the scale of the block in which it begins, and the steps are
/// chained from the first pose; rotations are unchanged. The scale of a block is that of the Sim(3) fit of
/// its own poses; if that is degenerate (fewer than three poses, no motion, no positive scale), the ratio of
/// the path lengths; without a path, `fallback`. Cost: linear.
std::vector<MatchedPose> rescale_blocks(const std::vector<MatchedPose>& matches, int block_frames,
                                        double fallback);

/// Scale (ground truth over estimate) of an interval of poses, as in rescale_blocks(). An interval
/// whose spread is below a millionth of `whole_spread_gt` or `whole_spread_est` counts as standing still.
double interval_scale(const std::vector<MatchedPose>& interval, double whole_spread_est,
                      double whole_spread_gt, double fallback);

}  // namespace edgevo
