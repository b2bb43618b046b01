// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Result of the frame that has just been processed, for clients that act on it at once: a servo loop, a
// window on the screen.
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/core/tracking_state.h"

namespace edgevo {

struct Reference;  // alignment/reference.h

/// Where a camera looks whose pose is not known.
struct Heading {
  /// Rotation from the frame of the keyframe poses to the camera.
  Eigen::Quaterniond R_cam_map = Eigen::Quaterniond::Identity();
  /// Covariance of w in R <- exp(w) R, which grows with the time since the last pose.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// A snapshot: what it points to never changes. Lengths are in the unit of the segment's map, which has its
/// origin at the segment's first keyframe. Cheap to copy.
struct NewestPose {
  /// Index of the frame in the source; -1: no frame yet.
  int frame_index = -1;
  /// Timestamp of the image.
  Timestamp time;
  /// Tracking state of the frame.
  TrackingState state = TrackingState::kBootstrapping;
  /// Why the state is not TRACKING; empty if it is.
  std::string note;
  /// Probability that the motion around the frame is right (confidence/motion_confidence.h); below
  /// kDoubtfulBelow (core/doubtful_frame.h) the pose is not to be trusted. NaN: unknown.
  double p_right = std::numeric_limits<double>::quiet_NaN();
  /// Segment of the map; poses of two segments have no reliable common frame. -1: none.
  int segment = -1;
  /// Pose in the frame of the keyframe poses of `reference`; none while LOST or BOOTSTRAPPING,
  /// nor of a frame that was located in a kept map before the run had one.
  std::optional<SE3> T_cam_map;
  /// Of a frame without a pose, where a gyro has followed the camera since the last one with one.
  std::optional<Heading> heading;
  /// From the segment's map to the frame of live poses, in which nothing jumps: p_odom = odom_scale R p + t.
  SE3 T_odom_map;
  /// See T_odom_map.
  double odom_scale = 1;
  /// From that frame to the world, as known by now, and the number of its changes so far: it changes when
  /// something is found about the past.
  SE3 T_world_odom;
  /// See T_world_odom.
  int world_changes = 0;
  /// Standard deviation of the logarithm of `odom_scale`; 0: that of the run.
  double scale_sigma = 0;
  /// Covariance of xi in T_cam_map <- exp(xi) T_cam_map, tangent [v, w], with the scale assumed known
  /// (alignment/pose_covariance.h). Zero: unknown.
  Matrix6d covariance = Matrix6d::Zero();
  /// Reference that the frame was tracked against; null without a map.
  std::shared_ptr<const Reference> reference;
};

/// Camera in the frame of live poses, where the camera is at `T_cam_map` in the segment's map.
SE3 T_odom_cam(const NewestPose& view, const SE3& T_cam_map);

}  // namespace edgevo
