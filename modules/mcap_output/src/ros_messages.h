// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// ROS 2 messages as bytes (cdr.h), of the definitions in ros_schemas.cpp. Frames and meanings are those of
// mcap_output.h.
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/occupancy_grid.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Head of most messages.
struct RosHeader {
  /// Time that the content belongs to.
  Timestamp time;
  /// Frame of its coordinates.
  std::string frame;
};

/// A transform: p_parent = T p_child.
struct RosTransform {
  /// Time and parent.
  RosHeader header;
  /// Name of the child.
  std::string child;
  /// The transform.
  SE3 T_parent_child;
};

/// A pose and its covariance, in ROS's order: position, rotation about fixed axes, both in those of the
/// header's frame.
struct RosPose {
  /// Pose.
  SE3 T;
  /// Its covariance.
  Matrix6d covariance = Matrix6d::Zero();
};

/// A velocity [v, w] in the axes of the moving frame, and its covariance.
struct RosTwist {
  /// Unit a second, radians a second.
  Vector6d velocity = Vector6d::Zero();
  /// Its covariance.
  Matrix6d covariance = Matrix6d::Zero();
};

/// A point of a cloud.
struct RosPoint {
  /// Coordinates.
  Eigen::Vector3f position;
  /// Gray level, 0 to 255.
  float intensity = 0;
  /// Standard deviation along the ray that it was seen on.
  float sigma = 0;
};

/// Lines that replace those of the same id.
struct RosLines {
  /// Number.
  int id = 0;
  /// Ends, two for each line.
  std::vector<Eigen::Vector3d> ends;
};

/// How important a message of the log is; the numbers are rcl_interfaces'.
enum class RosLevel : uint8_t { kInfo = 20, kWarn = 30, kError = 40 };

/// tf2_msgs/TFMessage.
std::string tf_message(const std::vector<RosTransform>& transforms);
/// nav_msgs/Odometry of `child` in the header's frame.
std::string odometry_message(const RosHeader& header, const std::string& child, const RosPose& pose,
                             const RosTwist& twist);
/// geometry_msgs/PoseStamped.
std::string pose_message(const RosHeader& header, const SE3& pose);
/// geometry_msgs/PoseWithCovarianceStamped.
std::string pose_with_covariance_message(const RosHeader& header, const RosPose& pose);
/// nav_msgs/Path of poses in the header's frame; each has a time of its own.
std::string path_message(const RosHeader& header, const std::vector<std::pair<Timestamp, SE3>>& poses);
/// sensor_msgs/PointCloud2 with the fields x, y, z, intensity, sigma.
std::string cloud_message(const RosHeader& header, const std::vector<RosPoint>& points);
/// visualization_msgs/MarkerArray of LINE_LISTs; `replaces_all`: all lines before it go.
std::string lines_message(const RosHeader& header, const std::vector<RosLines>& lines, bool replaces_all);
/// nav_msgs/OccupancyGrid.
std::string grid_message(const RosHeader& header, const OccupancyGrid& grid);
/// sensor_msgs/CameraInfo of images without distortion.
std::string camera_message(const RosHeader& header, const Pinhole& pinhole);
/// sensor_msgs/CompressedImage of a JPEG.
std::string image_message(const RosHeader& header, std::string_view jpeg);
/// rcl_interfaces/Log.
std::string log_message(Timestamp time, RosLevel level, const std::string& text);
/// std_msgs/Bool.
std::string bool_message(bool value);
/// std_msgs/UInt32.
std::string count_message(uint32_t value);

}  // namespace edgevo
