// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The frames map, odom and base_link while the run goes: from live poses and events, which have the axes of
// the camera and the unit of the odometry, to those of REP-105 and REP-103.
//
// With C from the camera to base_link (the mount, or that of a camera that looks straight ahead) and G from
// the frame of live poses to the same in metres (p_metres = factor p + offset),
//     T_odom_base = C G(T_odom_cam) C^-1          smooth: G changes so that the newest pose stays
//     T_map_odom  = C G T_world_odom G^-1 C^-1    rigid: changes with EpochsPlaced, and is counted
#include <map>
#include <vector>

#include "edgevo/map/map_event.h"

namespace edgevo {

/// The frames of one run. A value; for one thread.
class LiveFrames {
 public:
  /// `T_vehicle_cam` as in Run; without metres its lever arm is ignored.
  LiveFrames(const std::optional<SE3>& T_vehicle_cam, bool is_metric);

  /// A segment has begun.
  void follow(const SegmentPlaced& placed) { T_odom_map_[placed.segment] = placed.T_world_map; }
  /// The epochs were placed anew.
  void follow(const EpochsPlaced& placed);
  /// Metres per unit from now on, and their relative standard deviation; the newest pose stays.
  void set_metres_per_unit(double factor, double sigma);
  /// A frame has a pose: T_world_cam_live of its record.
  void note_pose(const SE3& T_odom_cam) { newest_ = T_odom_cam.translation(); }

  /// Whether lengths are metres.
  bool is_metric() const { return is_metric_; }
  /// From the camera to base_link.
  const SE3& T_base_cam() const { return T_base_cam_; }
  /// base_link in odom, of a live pose.
  SE3 T_odom_base(const SE3& T_odom_cam) const;
  /// odom in map.
  SE3 T_map_odom() const;
  /// From the map of a segment to the frame `map`, for what a keyframe hosts.
  Sim3 T_map_segment(int segment, int keyframe_id) const;
  /// Lengths in `odom` over those in the map of a segment, for frames of now.
  double metres_per_map_unit(int segment) const;
  /// Relative standard deviation of lengths as a whole; 0: unknown.
  double scale_sigma() const { return scale_sigma_; }
  /// Number of times that T_map_odom was announced anew.
  int changes() const { return changes_; }

 private:
  Sim3 to_metres() const { return {factor_, SE3(Eigen::Quaterniond::Identity(), offset_)}; }
  Sim3 T_world_segment(int segment, int keyframe_id) const;

  SE3 T_base_cam_;
  bool is_metric_ = false;
  double factor_ = 1, scale_sigma_ = 0;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero(), newest_ = Eigen::Vector3d::Zero();
  std::map<int, Sim3> T_odom_map_;  // by segment
  std::vector<EpochPlace> epochs_;
  SE3 T_world_odom_;
  int changes_ = 0;
};

/// Covariance of eta in T_odom_base <- T_odom_base exp(eta), in the axes of base_link, from that of
/// FrameRecord, whose lengths are to be multiplied by `length`.
Matrix6d body_covariance(const Matrix6d& covariance, double length, const SE3& T_base_cam);
/// The same as ROS states it (RosPose), in the axes of the frame that `T_parent_base` leads to.
Matrix6d in_parent(const Matrix6d& body_covariance, const SE3& T_parent_base);

}  // namespace edgevo
