#include "steady_motion.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/order_statistics.h"
#include "motion_model.h"

namespace edgevo {

namespace {

constexpr double kSteady = 3, kUnusual = 5;  // deviations
constexpr double kReferenceWidth = 1241, kLeastFlowPx = 2;  // less than this apart, at that width, two poses are one
constexpr double kNearDeviations = 3;   // how far from the usual step the other pose is sought
constexpr double kEnoughSupport = 0.85;  // of what the unusual step has

// On its way at an even speed. At a standstill, in a turn on the spot and of a camera moved about by hand no step is usual.
bool is_steady(const SteadyMotion::Step& usual) { return usual.translation.norm() > kSteady * usual.deviation.norm(); }

bool is_unusual(const SE3& T_cur_last, const SteadyMotion::Step& usual) {
  const Eigen::Vector3d translation = T_cur_last.log().head<3>();
  return ((translation - usual.translation).array().abs() > kUnusual * usual.deviation.array()).any();
}

// Rms image motion between two poses, pixels at kReferenceWidth.
double flow_px(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_a_ref, const SE3& T_b_ref) {
  const Eigen::Matrix3d R_a = T_a_ref.R(), R_b = T_b_ref.R();
  double square = 0;
  int counted = 0;
  for (const CloudPoint& p : cloud.points) {
    const Projection a = project(pinhole, R_a, T_a_ref.translation(), p.ray, p.idepth);
    const Projection b = project(pinhole, R_b, T_b_ref.translation(), p.ray, p.idepth);
    if (!a.valid || !b.valid || !pinhole.contains(a.px)) continue;
    square += (a.px - b.px).squaredNorm();
    ++counted;
  }
  return counted > 0 ? std::sqrt(square / counted) * kReferenceWidth / pinhole.width : 0;
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
    Eigen::Array3d square = (translation - median()).array().square();
    if (seen_ >= kFrames) square = square.min(9 * square_.array());  // one bad frame is no unsteady camera
    square_ += (square.matrix() - square_) / std::min(++seen_, kFrames);
  }
  steps_.push_back(translation);
  if (steps_.size() > kSteps) steps_.pop_front();
}

bool hold_steady(const MotionModel& motion, const FramePyramid& current, const ReferenceCloud& cloud, const AlignmentParams& params,
                 TrackResult* found) {
  const std::optional<SteadyMotion::Step> usual = motion.steady().usual();
  if (!usual || motion.frames_since() > 1 || !is_steady(*usual) || found->verdict == TrackingState::kLost) return false;
  const SE3 T_ref_last = motion.T_last_ref().inverse();
  if (!is_unusual(found->T_cur_ref * T_ref_last, *usual)) return false;
  Vector6d step = motion.velocity();  // its rotation
  step.head<3>() = usual->translation;
  const SE3 T_usual_ref = SE3::exp(step) * motion.T_last_ref();
  if (!(flow_px(current.finest().pinhole, cloud, T_usual_ref, found->T_cur_ref) > kLeastFlowPx)) return false;
  TrackResult near = track_near(current, cloud, {T_usual_ref, kNearDeviations * usual->deviation}, params);
  if (near.verdict == TrackingState::kLost || is_unusual(near.T_cur_ref * T_ref_last, *usual)) return false;  // the image will not have it
  if (support(near.evidence, params) < kEnoughSupport * support(found->evidence, params)) return false;
  *found = std::move(near);
  return true;
}

}  // namespace edgevo
