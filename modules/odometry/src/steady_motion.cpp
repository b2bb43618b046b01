#include "steady_motion.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/order_statistics.h"
#include "motion_model.h"
#include "view_change.h"

namespace edgevo {

namespace {

constexpr double kSteady = 3;   // deviations: a longer translation is one of a camera that is under way
constexpr double kUnusual = 5;  // deviations, on any axis: beyond what steps of such a camera do by chance
constexpr double kLeastFlowPx = 2;  // at kReferenceWidth: two poses less than this apart are one to the image
constexpr double kNearDeviations = 3;  // how far from the usual step the other pose is searched
// Of an unusual step, beside the usual one: one that the image shows leaves the usual one less than 0.82 of
// its support (drives, by hand).
constexpr double kUnusualLikelihood = 0.85;

bool is_steady(const SteadyMotion::Step& usual) {
  return usual.translation.norm() > kSteady * usual.deviation.norm();
}

}  // namespace

Eigen::Vector3d SteadyMotion::median() const {
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const Eigen::Vector3d& step : steps_) along.push_back(step[axis]);
    median[axis] = edgevo::median(std::move(along));
  }
  return median;
}

std::optional<SteadyMotion::Step> SteadyMotion::usual() const {
  if (steps_.size() < kSteps || seen_ < kFrames) return std::nullopt;
  return Step{median(), square_.cwiseSqrt()};
}

void SteadyMotion::follow(const Eigen::Vector3d& translation, bool held) {
  if (steps_.size() == kSteps && !held) {
    const Eigen::Vector3d square = (translation - median()).cwiseAbs2();
    square_ += (square - square_) / std::min(++seen_, kFrames);
  }
  steps_.push_back(translation);
  if (steps_.size() > kSteps) steps_.pop_front();
}

std::optional<UsualStep> UsualStep::of(const MotionModel& motion) {
  const std::optional<SteadyMotion::Step> step = motion.steady().usual();
  if (!step || motion.frames_since() > 1 || !is_steady(*step)) return std::nullopt;
  UsualStep usual;
  usual.step_ = *step;
  usual.T_last_ref_ = motion.T_last_ref();
  Vector6d xi = motion.velocity();  // its rotation
  xi.head<3>() = step->translation;
  usual.T_usual_ref_ = SE3::exp(xi) * usual.T_last_ref_;
  return usual;
}

double UsualStep::likelihood(const SE3& T_cur_ref) const {
  return is_unusual(T_cur_ref) ? kUnusualLikelihood : 1.0;
}

bool UsualStep::is_unusual(const SE3& T_cur_ref) const {
  const Eigen::Vector3d translation = (T_cur_ref * T_last_ref_.inverse()).log().head<3>();
  return ((translation - step_.translation).array().abs() > kUnusual * step_.deviation.array()).any();
}

bool UsualStep::is_apart(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cur_ref) const {
  return at_reference_width(pinhole, rms_flow_px(pinhole, cloud.points, T_usual_ref_, T_cur_ref)) >
         kLeastFlowPx;
}

PoseHypothesis UsualStep::hypothesis() const {
  return {T_usual_ref_, PoseHypothesis::Refinement::kEdges, kNearDeviations * step_.deviation};
}

}  // namespace edgevo
