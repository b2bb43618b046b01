// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Messages of ROS that are used, from their bytes in ROS 1's serialization or in CDR of either byte order.
// Times are of the header: when a sensor measured, not when it was recorded.
#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/recordings/recording.h"

namespace edgevo {

/// std_msgs/Header.
struct MessageHeader {
  /// Stamp; 0 if the sender left it out.
  Timestamp stamp;
  /// Coordinate frame, without the leading slash of ROS 1.
  std::string frame;
};

/// sensor_msgs/Image. The pixels point into the message.
struct ImageMessage {
  /// Time and frame.
  MessageHeader header;
  /// Size, pixels.
  int width = 0, height = 0;
  /// "mono8", "bgr8", "bayer_rggb8", ...
  std::string encoding;
  /// Byte order of 16-bit pixels.
  bool is_big_endian = false;
  /// Bytes from row to row.
  uint32_t step = 0;
  /// Rows of pixels.
  std::string_view pixels;
};

/// sensor_msgs/CompressedImage. The file points into the message.
struct CompressedImageMessage {
  /// Time and frame.
  MessageHeader header;
  /// "jpeg", "rgb8; png compressed bgr8", "16UC1; compressedDepth png", ...
  std::string format;
  /// A whole image file.
  std::string_view file;
};

/// sensor_msgs/CameraInfo.
struct CameraInfoMessage {
  /// Time and frame.
  MessageHeader header;
  /// Size of the images that the calibration is for, pixels, before roi and binning.
  int width = 0, height = 0;
  /// "plumb_bob", "rational_polynomial", "equidistant".
  std::string distortion_model;
  /// Coefficients of the lens.
  std::vector<double> D;
  /// Camera matrix, row by row; zeros: not calibrated.
  std::array<double, 9> K{};
  /// Projection matrix of the rectified image, row by row.
  std::array<double, 12> P{};
  /// Pixels that were added up, per side; 0 stands for 1.
  uint32_t binning_x = 0, binning_y = 0;
  /// Part of the full image that was kept, in its pixels; width 0: all.
  uint32_t roi_x = 0, roi_y = 0, roi_width = 0, roi_height = 0;
};

/// sensor_msgs/Imu.
struct ImuMessage {
  /// Time and frame.
  MessageHeader header;
  /// Rotation from the sensor to the world; zeros: not measured.
  Eigen::Vector4d orientation_xyzw = Eigen::Vector4d::Zero();
  /// rad/s and m/s^2, in the axes of the sensor.
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero(), acceleration = Eigen::Vector3d::Zero();
};

/// sensor_msgs/NavSatFix.
struct NavSatFixMessage {
  /// Time and frame.
  MessageHeader header;
  /// Whether there was a fix.
  bool has_fix = false;
  /// WGS84, degrees and metres above the ellipsoid.
  double latitude_deg = 0, longitude_deg = 0, altitude_m = 0;
};

/// nav_msgs/Odometry.
struct OdometryMessage {
  /// Time and frame.
  MessageHeader header;
  /// Frame whose pose it is.
  std::string child_frame;
  /// Pose in the frame of the header, metres.
  SE3 pose;
  /// Velocities in the child frame, m/s and rad/s.
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
};

/// geometry_msgs/PoseStamped, and PoseWithCovarianceStamped without its covariance.
struct PoseMessage {
  /// Time and frame.
  MessageHeader header;
  /// Pose in the frame of the header, metres.
  SE3 pose;
};

/// One of tf2_msgs/TFMessage.
struct TransformMessage {
  /// Time, and the frame that `T` maps to.
  MessageHeader header;
  /// The frame that it maps from.
  std::string child_frame;
  /// p_header = T p_child.
  SE3 T;
};

// All throw InputError, opened by `where`: the message is shorter than it says, or of another serialization.

/// Decodes sensor_msgs/Image.
ImageMessage decode_image(std::string_view bytes, Serialization, const std::string& where);
/// Decodes sensor_msgs/CompressedImage.
CompressedImageMessage decode_compressed_image(std::string_view bytes, Serialization,
                                               const std::string& where);
/// Decodes sensor_msgs/CameraInfo.
CameraInfoMessage decode_camera_info(std::string_view bytes, Serialization, const std::string& where);
/// Decodes sensor_msgs/Imu.
ImuMessage decode_imu(std::string_view bytes, Serialization, const std::string& where);
/// Decodes sensor_msgs/NavSatFix.
NavSatFixMessage decode_nav_sat_fix(std::string_view bytes, Serialization, const std::string& where);
/// Decodes nav_msgs/Odometry.
OdometryMessage decode_odometry(std::string_view bytes, Serialization, const std::string& where);
/// Decodes geometry_msgs/PoseStamped or PoseWithCovarianceStamped.
PoseMessage decode_pose(std::string_view bytes, Serialization, const std::string& where);
/// Decodes tf2_msgs/TFMessage.
std::vector<TransformMessage> decode_transforms(std::string_view bytes, Serialization,
                                                const std::string& where);
/// Decodes the header that a message begins with; `bytes` may end behind it.
MessageHeader decode_header(std::string_view bytes, Serialization, const std::string& where);
/// Bytes that hold the header of a message whose frame has a name of usual length.
constexpr size_t kHeaderBytes = 512;

}  // namespace edgevo
