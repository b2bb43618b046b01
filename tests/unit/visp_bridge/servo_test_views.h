// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Synthetic results of an odometry, for the tests of the servo feed.
#include "edgevo/alignment/reference.h"
#include "edgevo/odometry/newest_pose.h"

namespace edgevo::test {

inline const Vector6d kMotion = (Vector6d() << 0.2, -0.1, 0.05, 0.1, 0.3, -0.2).finished();

inline Timestamp at(double seconds) { return Timestamp::from_seconds(seconds); }

/// A map with its reference camera at the origin and the points of `cloud`.
inline std::shared_ptr<const Reference> reference_with(std::vector<CloudPoint> cloud, double residual_k1 = 0,
                                                       int keyframe_id = 0) {
  auto reference = std::make_shared<Reference>();
  reference->keyframe_id = keyframe_id;
  reference->cloud.points = std::move(cloud);
  reference->camera.applied.k1 = residual_k1;
  return reference;
}

inline NewestPose tracked(int index, double seconds, const SE3& T_cam_map, int segment = 0,
                          double residual_k1 = 0) {
  NewestPose view;
  view.frame_index = index;
  view.time = at(seconds);
  view.state = TrackingState::kTracking;
  view.segment = segment;
  view.T_cam_map = T_cam_map;
  view.covariance = 1e-6 * Matrix6d::Identity();
  view.reference = reference_with({}, residual_k1);
  return view;
}

inline NewestPose lost(int index, double seconds, const std::string& why) {
  NewestPose view;
  view.frame_index = index;
  view.time = at(seconds);
  view.state = TrackingState::kLost;
  view.note = why;
  return view;
}

}  // namespace edgevo::test
