// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/motion_model.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/tracker.h"

namespace edgevo {

Vector6d MotionModel::motion_since(double times) const {
  Vector6d xi = times * velocity_.log();
  if (known_) xi.tail<3>() = known_->since_last;
  return xi;
}

SE3 MotionModel::predict() const {
  if (known_) return SE3::exp(motion_since(std::max(1, frames_since_))) * T_last_ref_;
  return frames_since_ <= 1 ? velocity_ * T_last_ref_
                            : SE3::exp(velocity_.log() * double(frames_since_)) * T_last_ref_;
}

std::vector<SE3> MotionModel::starts() const {
  if (known_) {
    const double frames = std::max(1, frames_since_);
    std::vector<SE3> starts;
    for (const double times : {1.0, 0.0, 0.5})
      starts.push_back(SE3::exp(motion_since(times * frames)) * T_last_ref_);
    starts.push_back(SE3::exp(velocity_.log() * frames) * T_last_ref_);  // whatever the sensor says
    return starts;
  }
  if (frames_since_ <= 1) return motion_hypotheses(T_last_ref_, velocity_);
  const Vector6d drift = velocity_.log() * double(frames_since_);
  const SE3 on = SE3::exp(drift) * T_last_ref_, half = SE3::exp(0.5 * drift) * T_last_ref_;
  return {on, T_last_ref_, half};
}

std::optional<Vector6d> MotionModel::expected_twist() const {
  if (!(velocity_s_ > 0)) return std::nullopt;
  Vector6d twist = velocity_.log() / velocity_s_;
  if (known_) twist.tail<3>() = known_->rate;
  return twist;
}

Vector6d MotionModel::twist(const SE3& T_cur_ref) const {
  if (!(seconds_since_ > 0) || !T_cur_ref.is_finite()) return Vector6d::Zero();
  Vector6d twist = motion_to(T_cur_ref).log() / seconds_since_;
  if (frames_since_ <= 1 && velocity_s_ > 0) twist += 0.5 * (twist - velocity_.log() / velocity_s_);
  if (known_) twist.tail<3>() = known_->rate;
  return twist;
}

double MotionModel::step_to(const SE3& T_cur_ref) const {
  return motion_to(T_cur_ref).translation().norm() / std::max(frames_since_, 1);
}

void MotionModel::begin_frame(Timestamp time) {
  newest_ = clock_.tick(time);
  const bool known = newest_.seconds > 0 && (frames_since_ == 0 || seconds_since_ > 0);
  frames_since_ = std::min(frames_since_ + newest_.frames, FrameClock::kMaxFrames);
  seconds_since_ = known ? seconds_since_ + newest_.seconds : 0;
}

void MotionModel::follow(const SE3& T_cur_ref) {
  const SE3 motion = motion_to(T_cur_ref);
  const bool is_next = frames_since_ <= 1;
  velocity_ = is_next ? motion : SE3::exp(motion.log() / double(frames_since_));
  velocity_s_ = seconds_since_ / std::max(frames_since_, 1);
  T_last_ref_ = T_cur_ref;
  frames_since_ = 0;
  seconds_since_ = 0;
}

void MotionModel::restart(const std::optional<SE3>& motion) {
  T_last_ref_ = SE3();
  velocity_ = !motion || newest_.frames == 1 ? motion.value_or(SE3())
                                             : SE3::exp(motion->log() / double(newest_.frames));
  velocity_s_ = motion ? newest_.seconds / newest_.frames : 0;
  frames_since_ = 0;
  seconds_since_ = 0;
}

}  // namespace edgevo
