// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/median_motion_prior.h"

#include <cmath>
#include <limits>

#include "view_change.h"

namespace edgevo {

namespace {

// Sigmas of a step: a longer translation is that of a moving camera.
constexpr double kMovingSigmas = 3;
// Sigmas on any axis: a larger difference from the median is not by chance.
constexpr double kUnusualSigmas = 5;
// Pixels at kReferenceWidth: the image cannot distinguish two poses that are less apart.
constexpr double kMinFlowPx = 2;
// Sigmas around the median step in which the pose is searched.
constexpr double kNearSigmas = 3;

bool is_moving(const MedianMotion::Step& step) {
  return step.translation.norm() > kMovingSigmas * step.sigma.norm();
}

}  // namespace

double step_sigmas(const MotionModel& motion, const std::optional<MedianMotion::Step>& usual,
                   const SE3& T_cur_ref) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (!usual || motion.frames_since() > 1 || !(usual->sigma.minCoeff() > 0)) return kUnknown;
  const Eigen::Vector3d translation = motion.motion_to(T_cur_ref).log().head<3>();
  return (translation - usual->translation).cwiseAbs().cwiseQuotient(usual->sigma).maxCoeff();
}

std::optional<MedianMotionPrior> MedianMotionPrior::of(const MotionModel& motion,
                                                       const std::optional<MedianMotion::Step>& usual) {
  if (!usual || motion.frames_since() > 1 || !is_moving(*usual)) return std::nullopt;
  MedianMotionPrior prior;
  prior.step_ = *usual;
  prior.T_last_ref_ = motion.T_last_ref();
  Vector6d xi = motion.velocity();  // its rotation is kept
  xi.head<3>() = usual->translation;
  prior.T_expected_ref_ = SE3::exp(xi) * prior.T_last_ref_;
  return prior;
}

double MedianMotionPrior::likelihood(const SE3& T_cur_ref) const {
  return is_unusual(T_cur_ref) ? kUnusualLikelihood : 1.0;
}

bool MedianMotionPrior::is_unusual(const SE3& T_cur_ref) const {
  const Eigen::Vector3d translation = (T_cur_ref * T_last_ref_.inverse()).log().head<3>();
  return ((translation - step_.translation).array().abs() > kUnusualSigmas * step_.sigma.array()).any();
}

bool MedianMotionPrior::is_apart(const Pinhole& pinhole, const ReferenceCloud& cloud,
                                 const SE3& T_cur_ref) const {
  return at_reference_width(pinhole, rms_flow_px(pinhole, cloud.points, T_expected_ref_, T_cur_ref)) >
         kMinFlowPx;
}

PoseHypothesis MedianMotionPrior::hypothesis() const {
  return {T_expected_ref_, PoseHypothesis::Refinement::kEdges, kNearSigmas * step_.sigma};
}

}  // namespace edgevo
