// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/tracking_check.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/pose_covariance.h"

namespace edgevo {
namespace {

// Weight of the newest keyframe in the mean: the last three to five keyframes dominate.
constexpr double kNewestShare = 1.0 / 3;
// Factors on the variance that tracking reports, measured on rendered scenes
// (lab 2026-11-22_pose_covariance).
constexpr double kMaxFactor = 4;    // more is an outlier of one keyframe
constexpr double kMinFactor = 0.7;  // better agreement is chance, or one error in both
constexpr double kNotSeen = 1.15;   // true error over that move: the adjusted pose has an error as well

}  // namespace

double TrackingCheck::add(const SE3& T_cam_ref_tracked, const SE3& T_cam_ref_adjusted,
                          const Matrix6d& covariance) {
  const double ratio =
      normalised_error_square(T_cam_ref_tracked, T_cam_ref_adjusted, covariance) / kNormalisedErrorFreedom;
  if (std::isfinite(ratio)) mean_ += kNewestShare * (std::min(ratio, kMaxFactor) - mean_);
  return ratio;
}

double TrackingCheck::error_factor() const { return kNotSeen * std::max(kMinFactor, mean_); }

}  // namespace edgevo
