// SPDX-License-Identifier: BSD-3-Clause
#include "consistency_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/core/motion_tolerance.h"

namespace edgevo {
namespace {

// Most doubt by what right motions do, too: a camera that speeds up, a keyframe whose view is new.
constexpr double kMaxUnproven = 1;

// 0 for a value that is unknown or negative.
double limited(double value) { return value > 0 ? std::min(value, kMaxInconsistency) : 0.0; }

// A difference less its standard deviation, which may be unknown.
double beyond(double difference, double sigma) {
  return std::abs(difference) - (std::isfinite(sigma) ? sigma : 0.0);
}

// Corners know a length only if the camera has moved enough: not in a rotation on the spot.
bool knows_lengths(const CornerEvidence& c) {
  constexpr double kMaxSigma = 0.3;  // of the logarithm of the scale
  return c.change_10_sigma <= kMaxSigma;
}

double inconsistency_without_corners(const std::optional<CornerEvidence>& c) {
  constexpr int kMinCorners = 15;
  constexpr double kShows = 0.1, kDoesNotShow = 0.25, kShort = 0.02;
  if (!c || c->tracks < kMinCorners) return 1;
  if (c->motion_error_depths < kShort && std::isfinite(c->rotation_deg)) return 0;
  if (!std::isfinite(c->motion_sigma) || !knows_lengths(*c)) return 1;
  return std::clamp((c->motion_sigma - kShows) / (kDoesNotShow - kShows), 0.0, 1.0);
}

}  // namespace

double inconsistency_of_corner_motion(const CornerEvidence& c) {
  constexpr double kSigmas = 2.5;
  const double of_length =
      limited(beyond(c.motion_error, kSigmas * c.motion_sigma) / kMotionTolerance.share_of_length);
  const double of_depth = std::isfinite(c.motion_error_depths)
                              ? limited(c.motion_error_depths / kMotionTolerance.share_of_depth)
                              : of_length;
  // A wrong rotation breaks the epipolar constraint: where hardly a corner does, it is the corners' motion
  // that is wrong.
  constexpr double kContradicting = 0.2;
  const double credible =
      c.agreeing_share <= 1 ? std::min(1.0, (1 - c.agreeing_share) / kContradicting) : 1.0;
  const double turn =
      credible * limited(beyond(c.rotation_deg, c.rotation_sigma_deg) / kMotionTolerance.rotation_deg);
  return std::max(knows_lengths(c) ? std::min(of_length, of_depth) : 0.0, turn);
}

double inconsistency_of_focal_length(double focal_error, double sigma, double turn_deg) {
  constexpr double kSigmas = 2;
  if (!(std::abs(focal_error) > kSigmas * sigma)) return 0;
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

double inconsistency_without_cross_check(const std::optional<CornerEvidence>& c, double pose_sigma) {
  constexpr double kNoInformation = 0.1;
  const double by_corners = inconsistency_without_corners(c);
  return by_corners >= 1 && !(pose_sigma < kNoInformation) ? kMaxInconsistency : by_corners;
}

double inconsistency_of_turn(double turn_rad, double length_depths, double error_per_rad) {
  const double error = error_per_rad * turn_rad;  // median depths
  return std::min(limited(error / kMotionTolerance.share_of_depth),
                  limited(error / (kMotionTolerance.share_of_length * length_depths)));
}

double turn_error(const CornerEvidence& c, double turn_rad) {
  constexpr double kMinTurn = 0.05;
  return turn_rad > kMinTurn ? c.motion_error_depths / turn_rad : std::numeric_limits<double>::quiet_NaN();
}

double inconsistency_of_step(double recent, double usual, double median_depth) {
  constexpr double kSmall = 0.002;  // median depths a frame: a fifth of it is 2 % of the depth in ten frames
  const double small = std::isfinite(median_depth) ? kSmall * median_depth : 0.1 * usual;
  return std::min(kMaxUnproven, limited(std::abs(std::log((recent + small) / (usual + small)))));
}

double inconsistency_of_residual(double residual_px) {
  constexpr double kUsualPx = 0.6;
  return limited(std::log(residual_px / kUsualPx));
}

double inconsistency_of_adjustment(double moved) { return std::min(kMaxUnproven, limited(std::log(moved))); }

double inconsistency_of_starvation(const FrameEvidence& e) {
  constexpr double kManyInliers = 0.7, kFewInliers = 0.4, kManyPoints = 300, kWellInView = 0.3;
  const double outliers = limited((kManyInliers - e.inlier_share) / (kManyInliers - kFewInliers));
  const double lack = e.known_points ? limited(0.5 * std::log(kManyPoints / (*e.known_points + 1))) : 0.0;
  const double away = limited((kWellInView - e.view_share) / kWellInView);
  return limited(outliers + lack + away);
}

double inconsistency_of_image(double blur, double usual_blur, double saturated_share,
                              double usual_saturated) {
  constexpr double kSharp = 0.5, kBlurred = 0.1, kSaturated = 0.3;
  const double bound = std::isfinite(usual_blur) ? std::max(usual_blur, kSharp) : kSharp;
  return limited(limited((blur - bound) / kBlurred) +
                 limited((saturated_share - usual_saturated) / kSaturated));
}

}  // namespace edgevo
