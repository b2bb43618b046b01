#include "edgevo/odometry/tracking_check.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/pose_covariance.h"

namespace edgevo {
namespace {

// Weight of the newest keyframe in the mean: the last three to five count.
constexpr double kNewestShare = 1.0 / 3;
// Shares of the variance that tracking told, measured on rendered scenes
// (share/lab/archive/2026-11-22_pose_covariance.md).
constexpr double kMost = 4;        // more than that is an outlier of one keyframe
constexpr double kLeast = 0.7;     // agreement beyond that is chance, or one error in both
constexpr double kNotSeen = 1.15;  // truth over what the move shows: the adjusted pose errs as well

}  // namespace

void TrackingCheck::add(const SE3& T_cam_ref_tracked, const SE3& T_cam_ref_adjusted,
                        const Matrix6d& covariance) {
  const double ratio =
      normalised_error_square(T_cam_ref_tracked, T_cam_ref_adjusted, covariance) / kNormalisedErrorFreedom;
  if (std::isfinite(ratio)) mean_ += kNewestShare * (std::min(ratio, kMost) - mean_);
}

double TrackingCheck::error_factor() const { return kNotSeen * std::max(kLeast, mean_); }

}  // namespace edgevo
