// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/servo/motion_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr double kLeg_s = 1.6, kRest_s = 0.6, kAway_s = 3.5;

// Waypoints of the teaching phase as offsets from the taught pose in its own axes: metres and radians.
const std::array<Vector6d, 4>& teaching_offsets() {
  static const std::array<Vector6d, 4> offsets{
      (Vector6d() << -0.07, 0.02, -0.02, 0, 0.02, 0.04).finished(),
      (Vector6d() << 0.06, -0.04, -0.05, 0.02, -0.03, -0.05).finished(),
      (Vector6d() << 0.01, 0.06, 0.02, -0.03, 0.01, 0.03).finished(), Vector6d::Zero()};
  return offsets;
}

// Minimum-jerk step from 0 to 1: velocity and acceleration are 0 at both ends.
double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

SE3 between(const SE3& from, const SE3& to, double share) {
  return from * SE3::exp(share * (from.inverse() * to).log());
}

SE3 look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized(),
                        right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d R;
  R.col(0) = right, R.col(1) = forward.cross(right), R.col(2) = forward;
  return {R, eye};
}

}  // namespace

Phase MotionPlan::phase(double seconds) const {
  if (seconds < teach_s) return Phase::kTeach;
  return seconds < teach_s + away_s ? Phase::kAway : Phase::kServo;
}

SE3 MotionPlan::T_scene_cam(double seconds) const {
  const auto& offsets = teaching_offsets();
  const double legs = std::max(seconds, 0.0) / kLeg_s;
  const size_t leg = size_t(legs);
  if (leg + 1 < offsets.size())
    return T_scene_taught *
           between(SE3::exp(offsets[leg]), SE3::exp(offsets[leg + 1]), smooth_step(legs - double(leg)));
  return between(T_scene_taught, T_scene_start, smooth_step((seconds - teach_s) / away_s));
}

SE3 moved_by_hand(double seconds) {
  const auto& offsets = teaching_offsets();  // the last one is none
  const double legs = seconds / kLeg_s;
  const size_t leg = size_t(legs), count = offsets.size();
  return between(SE3::exp(offsets[(leg + count - 1) % count]), SE3::exp(offsets[leg % count]),
                 smooth_step(legs - double(leg)));
}

SE3 on_the_way(const SE3& from, const SE3& to, double share) { return between(from, to, smooth_step(share)); }

MotionPlan plan_over_desk(uint64_t seed) {
  MotionPlan plan;
  const Eigen::Vector3d middle(0.9, 0.0, 0.74);  // of the desk in front of the monitors
  const Eigen::Vector3d away(-0.5, 0.0, std::sqrt(0.75));
  plan.T_scene_taught = look_at(middle + 0.5 * away, middle);
  Vector6d offset = (Vector6d() << 0.13, -0.10, -0.16, 0.10, -0.20, 0.30).finished();
  Random random = Random::derive(seed, 0x736572766f);
  if (seed != 1)
    for (int i = 0; i < 6; ++i) offset[i] *= random.uniform(0.8, 1.2);
  plan.T_scene_start = plan.T_scene_taught * SE3::exp(offset);
  plan.teach_s = kLeg_s * double(teaching_offsets().size() - 1) + kRest_s;
  plan.away_s = kAway_s;
  return plan;
}

}  // namespace edgevo
