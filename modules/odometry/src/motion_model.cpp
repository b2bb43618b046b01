#include "motion_model.h"

#include "edgevo/alignment/tracker.h"

namespace edgevo {

std::vector<SE3> MotionModel::starts() const {
  if (missed_ == 0) return motion_hypotheses(T_last_ref_, velocity_);
  const Vector6d drift = velocity_.log() * double(missed_ + 1);
  const SE3 on = SE3::exp(drift) * T_last_ref_, half = SE3::exp(0.5 * drift) * T_last_ref_;
  if (missed_ > kLongGap) return {T_last_ref_, half, on};  // nobody moves on as before for long
  return {on, T_last_ref_, half};
}

std::optional<Vector6d> MotionModel::expected_twist() const {
  if (!(velocity_s_ > 0)) return std::nullopt;
  return Vector6d(velocity_.log() / velocity_s_);
}

Vector6d MotionModel::twist(Timestamp time, const SE3& T_cur_ref) const {
  const double seconds = seconds_between(time_, time);
  if (!(seconds > 0) || !T_cur_ref.is_finite()) return Vector6d::Zero();
  const Vector6d twist = (T_cur_ref * T_last_ref_.inverse()).log() / seconds;
  const std::optional<Vector6d> expected = expected_twist();
  if (missed_ > 0 || !expected) return twist;
  return twist + 0.5 * (twist - *expected);
}

void MotionModel::follow(Timestamp time, const SE3& T_cur_ref, bool held) {
  const SE3 motion = T_cur_ref * T_last_ref_.inverse();
  if (missed_ == 0)
    steady_.follow(motion.log().head<3>(), held);
  else
    steady_.interrupt();
  velocity_s_ = seconds_between(time_, time) / double(missed_ + 1);
  velocity_ = missed_ == 0 ? motion : SE3::exp(motion.log() / double(missed_ + 1));
  time_ = time;
  T_last_ref_ = T_cur_ref;
  missed_ = 0;
}

void MotionModel::restart(Timestamp time, const SE3& motion, double seconds) {
  T_last_ref_ = SE3();
  steady_ = SteadyMotion();  // the unit of length is another
  velocity_ = motion;
  velocity_s_ = seconds;
  time_ = time;
  missed_ = 0;
}

}  // namespace edgevo
