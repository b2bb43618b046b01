#pragma once
// The map of a running odometry as objects of an MRPT scene: path, camera, points of the keyframes, points
// seen now.
#include <mrpt/opengl/COpenGLViewport.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>

#include <optional>

#include "edgevo/odometry/odometry.h"

namespace edgevo {

class ViewMap {
 public:
  /// `T_vehicle_cam`: as for Run; the world is that of the map files (T_map_world).
  ViewMap(const std::optional<SE3>& T_vehicle_cam, mrpt::opengl::COpenGLViewport* viewport);

  /// Brings the objects up to date; call while the scene is locked. Cost: grows with what is new since the
  /// last call, but for a correction of the camera, after which all points are made again.
  void update(const FrameRecord& record, const Odometry& odometry, const FrameView& view);
  /// Position of the camera, in the world of the map; none before the first pose.
  const std::optional<Eigen::Vector3d>& camera() const { return camera_; }
  /// Median depth of the points seen last: how large things are. 0 before the first.
  double median_depth() const { return median_depth_; }

 private:
  void add_settled(const SettledKeyframes& settled, const Pinhole& pinhole);
  void draw_seen(const SE3& T_map_cam, const FrameView& view);
  void draw_camera(const SE3& T_map_cam, const Pinhole& pinhole);

  SE3 T_map_world_;
  mrpt::opengl::CPointCloudColoured::Ptr settled_points_, seen_points_;
  mrpt::opengl::CSetOfLines::Ptr path_, frustum_;
  std::optional<Eigen::Vector3d> camera_;
  double median_depth_ = 0;
  size_t settled_keyframes_ = 0;
  int revision_ = 0, segment_ = -1;
};

}  // namespace edgevo
