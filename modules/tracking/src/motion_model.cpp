// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/motion_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/alignment/tracker.h"

namespace edgevo {

SE3 MotionModel::predict() const {
  return frames_since_ <= 1 ? velocity_ * T_last_ref_
                            : SE3::exp(velocity_.log() * double(frames_since_)) * T_last_ref_;
}

std::vector<SE3> MotionModel::starts() const {
  if (frames_since_ <= 1) return motion_hypotheses(T_last_ref_, velocity_);
  const Vector6d drift = velocity_.log() * double(frames_since_);
  const SE3 on = SE3::exp(drift) * T_last_ref_, half = SE3::exp(0.5 * drift) * T_last_ref_;
  return {on, T_last_ref_, half};
}

std::optional<Vector6d> MotionModel::expected_twist() const {
  if (!(velocity_s_ > 0)) return std::nullopt;
  return Vector6d(velocity_.log() / velocity_s_);
}

Vector6d MotionModel::twist(const SE3& T_cur_ref) const {
  if (!(seconds_since_ > 0) || !T_cur_ref.is_finite()) return Vector6d::Zero();
  const Vector6d twist = (T_cur_ref * T_last_ref_.inverse()).log() / seconds_since_;
  const std::optional<Vector6d> expected = expected_twist();
  if (frames_since_ > 1 || !expected) return twist;
  return twist + 0.5 * (twist - *expected);
}

double MotionModel::step_to(const SE3& T_cur_ref) const {
  return (T_cur_ref * T_last_ref_.inverse()).translation().norm() / std::max(frames_since_, 1);
}

double MotionModel::largest_step(double median_depth) const {
  constexpr double kTimes = 10;
  // A camera that stands still may start to move: its steps up to this share of the depth are small ones.
  constexpr double kSmallShare = 0.002;
  const double usual = steps_.median();
  if (!std::isfinite(usual)) return std::numeric_limits<double>::infinity();
  return kTimes * std::max({usual, steps_.mean(1), kSmallShare * median_depth});
}

Eigen::Vector3d MotionModel::typical_step() const {
  const double usual = steps_.median();
  return std::isfinite(usual) ? Eigen::Vector3d(usual * direction_) : Eigen::Vector3d::Zero();
}

void MotionModel::begin_frame(Timestamp time) {
  newest_ = clock_.tick(time);
  const bool known = newest_.seconds > 0 && (frames_since_ == 0 || seconds_since_ > 0);
  frames_since_ = std::min(frames_since_ + newest_.frames, FrameClock::kMaxFrames);
  seconds_since_ = known ? seconds_since_ + newest_.seconds : 0;
}

void MotionModel::follow(const SE3& T_cur_ref, bool held) {
  const SE3 motion = T_cur_ref * T_last_ref_.inverse();
  const bool is_next = frames_since_ <= 1;
  // A camera that stands at a light goes on as fast as it came.
  constexpr double kStands = 0.1;
  if (const double step = step_to(T_cur_ref); !(step < kStands * steps_.median())) {
    steps_.add(step);
    direction_ = motion.translation().normalized();
  }
  if (is_next)
    median_motion_.follow(motion.log().head<3>(), held);
  else
    median_motion_.interrupt();
  velocity_ = is_next ? motion : SE3::exp(motion.log() / double(frames_since_));
  velocity_s_ = seconds_since_ / std::max(frames_since_, 1);
  T_last_ref_ = T_cur_ref;
  frames_since_ = 0;
  seconds_since_ = 0;
}

void MotionModel::rescale(double scale_ratio) {
  const auto scaled = [&](const SE3& T) { return SE3(T.rotation(), scale_ratio * T.translation()); };
  T_last_ref_ = scaled(T_last_ref_);
  velocity_ = scaled(velocity_);
  steps_.multiply(scale_ratio);
  median_motion_ = MedianMotion();
}

void MotionModel::restart(const std::optional<SE3>& motion) {
  T_last_ref_ = SE3();
  median_motion_ = MedianMotion();  // the unit of length is a new one
  steps_.clear();
  direction_.setZero();
  velocity_ = !motion || newest_.frames == 1 ? motion.value_or(SE3())
                                             : SE3::exp(motion->log() / double(newest_.frames));
  velocity_s_ = motion ? newest_.seconds / newest_.frames : 0;
  frames_since_ = 0;
  seconds_since_ = 0;
}

}  // namespace edgevo
