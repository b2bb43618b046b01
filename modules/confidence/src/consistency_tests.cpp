// SPDX-License-Identifier: BSD-3-Clause
#include "consistency_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/core/motion_tolerance.h"

namespace edgevo {
namespace {

// 0 for a value that is unknown or negative.
double limited(double value) { return value > 0 ? std::min(value, kMaxInconsistency) : 0.0; }

// A difference less its standard deviation, which may be unknown.
double beyond(double difference, double sigma) {
  return std::abs(difference) - (std::isfinite(sigma) ? sigma : 0.0);
}

// Corners know a length only if the camera has moved enough: not in a rotation on the spot.
bool knows_lengths(const CornerEvidence& c, const ConsistencyParams& params) {
  return c.change_10_sigma <= params.max_scale_sigma;
}

double inconsistency_without_corners(const std::optional<CornerEvidence>& c,
                                     const ConsistencyParams& params) {
  if (!c || c->tracks < params.min_corners) return 1;
  if (c->motion_error_depths < params.short_motion && std::isfinite(c->rotation_deg)) return 0;
  if (!std::isfinite(c->motion_sigma) || !knows_lengths(*c, params)) return 1;
  const double sure = params.sure_motion_sigma, vague = params.vague_motion_sigma;
  return std::clamp((c->motion_sigma - sure) / (vague - sure), 0.0, 1.0);
}

}  // namespace

double inconsistency_of_corner_motion(const CornerEvidence& c, const ConsistencyParams& params) {
  const double of_length = limited(beyond(c.motion_error, params.corner_length_sigmas * c.motion_sigma) /
                                   kMotionTolerance.share_of_length);
  const double of_depth = std::isfinite(c.motion_error_depths)
                              ? limited(c.motion_error_depths / kMotionTolerance.share_of_depth)
                              : of_length;
  // A wrong rotation breaks the epipolar constraint: where hardly a corner does, it is the corners' motion
  // that is wrong.
  const double credible =
      c.agreeing_share <= 1 ? std::min(1.0, (1 - c.agreeing_share) / params.contradicting_share) : 1.0;
  const double turn =
      credible * limited(beyond(c.rotation_deg, c.rotation_sigma_deg) / kMotionTolerance.rotation_deg);
  return std::max(knows_lengths(c, params) ? std::min(of_length, of_depth) : 0.0, turn);
}

double inconsistency_of_focal_length(double focal_error, double sigma, double turn_deg,
                                     const ConsistencyParams& params) {
  if (!(std::abs(focal_error) > params.focal_sigmas * sigma)) return 0;
  return limited(std::abs(focal_error) / (1 + focal_error) * turn_deg / kMotionTolerance.rotation_deg);
}

double inconsistency_of_corner_scale(const CornerEvidence& c) {
  constexpr double kWrong = 0.223;  // log(1 + kMotionTolerance.share_of_length)
  return std::max(limited(beyond(c.change_10, c.change_10_sigma) / kWrong),
                  limited(beyond(c.change_50, c.change_50_sigma) / kWrong));
}

double inconsistency_of_corner_agreement(const CornerEvidence& c) {
  return limited(2 * (1 - c.agreeing_share));
}

double inconsistency_without_cross_check(const std::optional<CornerEvidence>& c, double pose_sigma,
                                         const ConsistencyParams& params) {
  const double by_corners = inconsistency_without_corners(c, params);
  return by_corners >= 1 && !(pose_sigma < params.no_information_sigma) ? kMaxInconsistency : by_corners;
}

double inconsistency_of_turn(double turn_rad, double length_depths, double error_per_rad) {
  const double error = error_per_rad * turn_rad;  // median depths
  return std::min(limited(error / kMotionTolerance.share_of_depth),
                  limited(error / (kMotionTolerance.share_of_length * length_depths)));
}

double turn_error(const CornerEvidence& c, double turn_rad, const ConsistencyParams& params) {
  return turn_rad > params.min_turn_rad ? c.motion_error_depths / turn_rad
                                        : std::numeric_limits<double>::quiet_NaN();
}

double inconsistency_of_step(double recent, double usual, double median_depth, double small_step,
                             const ConsistencyParams& params) {
  const double small = std::isfinite(median_depth) ? small_step * median_depth : 0.1 * usual;
  return std::min(params.max_unproven, limited(std::abs(std::log((recent + small) / (usual + small)))));
}

double inconsistency_of_residual(double residual_px, const ConsistencyParams& params) {
  return limited(std::log(residual_px / params.usual_residual_px));
}

double inconsistency_of_adjustment(double moved, const ConsistencyParams& params) {
  return std::min(params.max_unproven, limited(std::log(moved)));
}

double inconsistency_of_starvation(const FrameEvidence& e, const ConsistencyParams& params) {
  const double many = params.many_inliers, wide = params.wide_view_share;
  const double outliers = limited((many - e.inlier_share) / (many - params.few_inliers));
  const double lack =
      e.known_points ? limited(0.5 * std::log(params.many_points / (*e.known_points + 1))) : 0.0;
  const double away = limited((wide - e.view_share) / wide);
  return limited(outliers + lack + away);
}

double inconsistency_of_image(double blur, double usual_blur, double saturated_share, double usual_saturated,
                              const ConsistencyParams& params) {
  const double sharp = params.sharp_blur;
  const double bound = std::isfinite(usual_blur) ? std::max(usual_blur, sharp) : sharp;
  return limited(limited((blur - bound) / params.blur_range) +
                 limited((saturated_share - usual_saturated) / params.saturated_range));
}

}  // namespace edgevo
