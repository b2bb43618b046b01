// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/segment_join.h"

#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/motion_tolerance.h"

namespace edgevo {
namespace {

// Speed, in lengths per second, below which a camera stands still.
constexpr double kStill = 1e-9;

// Standard deviation of the logarithm of a unit by the depths of what is in view.
constexpr double kSigmaOfDepths = 0.3;

// Speed during the bootstrap, in the unit of its map.
double speed_of(const MapBeginning& beginning) {
  return beginning.T_last_first.inverse().translation().norm() /
         seconds_between(beginning.first, beginning.last);
}

// Mean velocity in the world, from the first pose to the last.
Eigen::Vector3d velocity_of(const std::vector<TimedPose>& poses) {
  return (poses.back().T_world_cam.translation() - poses.front().T_world_cam.translation()) /
         seconds_between(poses.front().time, poses.back().time);
}

SE3 scaled(double scale, const SE3& T) { return SE3(T.rotation(), scale * T.translation()); }

}  // namespace

SegmentPlaced join_segment(int segment, const std::vector<TimedPose>& previous,
                           const std::vector<TimedPose>& sure, const MapBeginning& beginning,
                           std::optional<double> scale) {
  using Method = SegmentPlaced::Method;
  // Standard deviations of a logarithm. In two seconds a car brakes to half its speed.
  constexpr double kOfSpeed = 0.5, kOfNothing = 1;
  // Of the direction, and what a car or a hand turns by in a second.
  constexpr double kOfDirection = rad(3), kTurnPerSecond = rad(20);
  SegmentPlaced join;
  join.segment = segment;
  if (previous.size() < 2) return join;
  const TimedPose& newest = previous.back();
  const Eigen::Vector3d here = newest.T_world_cam.translation();
  Eigen::Vector3d velocity = velocity_of(previous);
  if (sure.size() >= 2 && velocity.norm() > kStill) velocity *= velocity_of(sure).norm() / velocity.norm();
  const double gap = seconds_between(newest.time, beginning.first);
  Eigen::Quaterniond R_world_first = newest.T_world_cam.rotation();
  join.rotation_sigma = kOfDirection + kTurnPerSecond * gap;
  Eigen::Vector3d on_the_way = velocity;
  if (beginning.turn) {  // a camera that turns looks on along its way
    R_world_first = R_world_first * beginning.turn->R.conjugate();
    join.rotation_sigma = beginning.turn->sigma;
    on_the_way = 0.5 * (velocity + R_world_first * (newest.T_world_cam.rotation().conjugate() * velocity));
  }
  join.T_world_map.rigid = SE3(R_world_first, here + gap * on_the_way);
  join.position_sigma = kOfSpeed * gap * velocity.norm();
  const double new_speed = speed_of(beginning);
  if (scale) {
    join.method = Method::kDepthRatio;
    join.T_world_map.scale = *scale;
    join.scale_sigma = kSigmaOfDepths;
  } else if (velocity.norm() > kStill && new_speed > kStill) {
    join.method = Method::kVelocity;
    join.T_world_map.scale = velocity.norm() / new_speed;
    join.scale_sigma = kOfSpeed;
  } else {
    join.method = Method::kStandstill;
    join.scale_sigma = kOfNothing;
  }
  return join;
}

Constraint constraint_of(const SegmentLink& link, const Reference& a, const Reference& b) {
  // Of a motion from the features of two views: chosen, several times what such motions are off by in drives.
  constexpr double kRotation = rad(1), kShareOfLength = 0.1;
  const SE3 T_a_b = link.T_b_a.inverse();
  const double position = std::hypot(kShareOfLength * T_a_b.translation().norm(),
                                     kMotionTolerance.share_of_depth / a.median_idepth);
  Constraint c;
  c.from = NodeId::keyframe(a.keyframe_id), c.to = NodeId::keyframe(b.keyframe_id);
  c.T_from_to = {link.scale, T_a_b};
  c.kind = ConstraintKind::kFeatures;
  c.covariance.diagonal() << Eigen::Vector3d::Constant(position * position),
      Eigen::Vector3d::Constant(kRotation * kRotation), link.sigma * link.sigma;
  return c;
}

SegmentPlaced link_segment(int segment, const Reference& before, const Sim3& T_world_before,
                           const Reference& after, const SegmentLink& link) {
  SegmentPlaced join;
  join.segment = segment;
  join.method = SegmentPlaced::Method::kLinked;
  join.scale_sigma = link.sigma;
  join.T_world_map.scale = T_world_before.scale * link.scale;
  const SE3 T_world_after = T_world_before.apply((link.T_b_a * before.T_ref_world).inverse());
  join.T_world_map.rigid = T_world_after * scaled(join.T_world_map.scale, after.T_ref_world);
  return join;
}

SegmentPlaced locate_segment(int segment, const LocatedPose& located, const SE3& T_cam_map,
                             double median_depth) {
  SegmentPlaced join;
  join.segment = segment;
  join.method = SegmentPlaced::Method::kLinked;
  join.scale_sigma = kSigmaOfDepths;
  join.T_world_map.scale = located.median_depth / median_depth;
  join.T_world_map.rigid = located.T_world_cam * scaled(join.T_world_map.scale, T_cam_map);
  join.position_sigma = std::sqrt(located.covariance.topLeftCorner<3, 3>().trace() / 3);
  join.rotation_sigma = std::sqrt(located.covariance.bottomRightCorner<3, 3>().trace() / 3);
  return join;
}

Constraint place_of(int keyframe_id, const SE3& T_keyframe_map, const SegmentPlaced& located) {
  Constraint c;
  c.from = NodeId::world(), c.to = NodeId::keyframe(keyframe_id);
  c.kind = ConstraintKind::kContinuity;
  c.T_from_to = located.T_world_map * Sim3{1, T_keyframe_map.inverse()};
  c.centre = c.T_from_to.rigid.translation();
  c.covariance.diagonal() << Eigen::Vector3d::Constant(std::pow(located.position_sigma, 2)),
      Eigen::Vector3d::Constant(std::pow(located.rotation_sigma, 2)), std::pow(located.scale_sigma, 2);
  return c;
}

}  // namespace edgevo
