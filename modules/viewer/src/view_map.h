// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map of a running odometry as objects of an MRPT scene: path, camera, points of marginalised keyframes,
// points in view.
#include <mrpt/opengl/COpenGLViewport.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>

#include <optional>

#include "edgevo/map/map_log.h"
#include "edgevo/tracking/frame_view.h"
#include "view_keyframes.h"

namespace edgevo {

/// The objects of the scene.
class ViewMap {
 public:
  /// `T_vehicle_cam`: as in Run. `log`: events of the run. The world is that of the map files (T_map_world).
  ViewMap(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log,
          mrpt::opengl::COpenGLViewport* viewport);

  /// Updates the objects; call while the scene is locked. Cost: proportional to what is new since the last
  /// call; after a move of the map all points are made again.
  void update(const FrameRecord& record, const FrameView& view);
  /// Position of the camera in the world of the map; nullopt before the first pose.
  const std::optional<Eigen::Vector3d>& camera() const { return camera_; }
  /// Median depth of the points in the last frame with points, as the scale of the scene; 0 before.
  double median_depth() const { return median_depth_; }

 private:
  void follow_map(const Pinhole& pinhole);
  void draw_keyframe(const KeyframeRecord& keyframe, const Pinhole& pinhole);
  void draw_seen(const SE3& T_map_cam, const FrameView& view);
  void draw_camera(const SE3& T_map_cam, const Pinhole& pinhole);

  SE3 T_map_world_;
  mrpt::opengl::CPointCloudColoured::Ptr map_points_, seen_points_;
  mrpt::opengl::CSetOfLines::Ptr path_, frustum_;
  std::optional<Eigen::Vector3d> camera_;
  double median_depth_ = 0;
  MapCursor events_;
  ViewKeyframes keyframes_;
  /// Number of keyframes drawn, and of the moves before.
  size_t drawn_ = 0;
  int moves_ = 0;
  int segment_ = -1;
};

}  // namespace edgevo
