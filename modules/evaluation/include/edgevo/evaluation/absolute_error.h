#pragma once
// Absolute trajectory error (ATE): align once, then look at the distance of each position from ground truth.
//
//   ATE Sim(3)   Umeyama with scale (evo_ape -as): for monocular estimates, whose unit is arbitrary
//   ATE SE(3)    Umeyama without scale (evo_ape -a): only for estimates in metres
//   ATE200       the paper's: the scale is re-corrected from ground truth every 200 input frames (rescale_blocks), then
//                SE(3); it shows the local geometry without the drift of the monocular scale
#include <optional>
#include <vector>

#include "edgevo/evaluation/association.h"
#include "edgevo/evaluation/similarity_fit.h"

namespace edgevo {

/// Distances from ground truth after alignment, metres.
struct AbsoluteError {
  double rmse = 0, mean = 0, median = 0, max = 0;  ///< over the poses, metres
  int poses = 0;  ///< that were compared
  double scale = 1;  ///< that the alignment multiplied the estimate with
};

/// Estimated positions of `matches`, one a column; estimate_points in its own unit, truth_points in metres.
Points estimate_points(const std::vector<MatchedPose>& matches);
Points truth_points(const std::vector<MatchedPose>& matches);  ///< True positions, likewise.

/// nullopt where the fit is (similarity_fit.h).
std::optional<AbsoluteError> ate_sim3(const std::vector<MatchedPose>& matches);
/// nullopt where the fit is; for an estimate in metres.
std::optional<AbsoluteError> ate_se3(const std::vector<MatchedPose>& matches);

/// `matches` with T_est in metres: cut into blocks of `block_frames` consecutive INPUT frames, the step from a pose to the
/// next one multiplied by the scale of the block in which it begins, and chained again from the first pose; rotations
/// stay. A block's scale is that of the Sim(3) fit of its own poses; where that degenerates (fewer than three poses, a
/// block that stands still or no positive scale) the ratio of the path lengths; where there is no path either, `fallback`.
/// Cost: linear.
std::vector<MatchedPose> rescale_blocks(const std::vector<MatchedPose>& matches, int block_frames, double fallback);

/// Scale (ground truth over estimate) of a stretch of poses, by the rule of rescale_blocks. `whole_spread_gt` and
/// `whole_spread_est` tell what standing still means: a spread under a millionth of these.
double stretch_scale(const std::vector<MatchedPose>& stretch, double whole_spread_est, double whole_spread_gt,
                     double fallback);

}  // namespace edgevo
