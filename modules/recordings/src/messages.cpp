// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/recordings/messages.h"

#include "message_reader.h"

namespace edgevo {
namespace {

constexpr uint32_t kMaxSide = 1 << 16;  // pixels
constexpr size_t kCovariance = 36;      // numbers, 6 x 6

int side(MessageReader* m) {
  const auto pixels = m->number<uint32_t>();
  if (pixels > kMaxSide) m->fail("a side of " + std::to_string(pixels) + " pixels");
  return int(pixels);
}

void skip_covariance(MessageReader* m, size_t count) {
  for (size_t i = 0; i < count; ++i) m->number<double>();
}

std::string without_slash(std::string frame) {
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
  return frame;
}

}  // namespace

MessageHeader decode_header(std::string_view bytes, Serialization serialization, const std::string& where) {
  return MessageReader(bytes, serialization, where).header();
}

ImageMessage decode_image(std::string_view bytes, Serialization serialization, const std::string& where) {
  MessageReader m(bytes, serialization, where);
  ImageMessage image;
  image.header = m.header();
  image.height = side(&m);
  image.width = side(&m);
  image.encoding = m.text();
  image.is_big_endian = m.number<uint8_t>() != 0;
  image.step = m.number<uint32_t>();
  image.pixels = m.bytes();
  return image;
}

CompressedImageMessage decode_compressed_image(std::string_view bytes, Serialization serialization,
                                               const std::string& where) {
  MessageReader m(bytes, serialization, where);
  CompressedImageMessage image;
  image.header = m.header();
  image.format = m.text();
  image.file = m.bytes();
  return image;
}

CameraInfoMessage decode_camera_info(std::string_view bytes, Serialization serialization,
                                     const std::string& where) {
  MessageReader m(bytes, serialization, where);
  CameraInfoMessage info;
  info.header = m.header();
  info.height = side(&m);
  info.width = side(&m);
  info.distortion_model = m.text();
  info.D = m.numbers();
  m.fill(info.K.data(), info.K.size());
  std::array<double, 9> R;  // rectification
  m.fill(R.data(), R.size());
  m.fill(info.P.data(), info.P.size());
  info.binning_x = m.number<uint32_t>();
  info.binning_y = m.number<uint32_t>();
  info.roi_x = m.number<uint32_t>();
  info.roi_y = m.number<uint32_t>();
  info.roi_height = m.number<uint32_t>();
  info.roi_width = m.number<uint32_t>();
  return info;
}

ImuMessage decode_imu(std::string_view bytes, Serialization serialization, const std::string& where) {
  constexpr size_t kSmallCovariance = 9;  // numbers, 3 x 3
  MessageReader m(bytes, serialization, where);
  ImuMessage imu;
  imu.header = m.header();
  m.fill(imu.orientation_xyzw.data(), 4);
  skip_covariance(&m, kSmallCovariance);
  imu.angular_velocity = m.vector();
  skip_covariance(&m, kSmallCovariance);
  imu.acceleration = m.vector();
  return imu;
}

NavSatFixMessage decode_nav_sat_fix(std::string_view bytes, Serialization serialization,
                                    const std::string& where) {
  MessageReader m(bytes, serialization, where);
  NavSatFixMessage fix;
  fix.header = m.header();
  fix.has_fix = m.number<int8_t>() >= 0;
  m.number<uint16_t>();  // satellite systems in use
  fix.latitude_deg = m.number<double>();
  fix.longitude_deg = m.number<double>();
  fix.altitude_m = m.number<double>();
  return fix;
}

OdometryMessage decode_odometry(std::string_view bytes, Serialization serialization,
                                const std::string& where) {
  MessageReader m(bytes, serialization, where);
  OdometryMessage odometry;
  odometry.header = m.header();
  odometry.child_frame = without_slash(m.text());
  odometry.pose = m.pose();
  skip_covariance(&m, kCovariance);
  odometry.linear = m.vector();
  odometry.angular = m.vector();
  return odometry;
}

PoseMessage decode_pose(std::string_view bytes, Serialization serialization, const std::string& where) {
  MessageReader m(bytes, serialization, where);
  PoseMessage pose;
  pose.header = m.header();
  pose.pose = m.pose();
  return pose;
}

std::vector<TransformMessage> decode_transforms(std::string_view bytes, Serialization serialization,
                                                const std::string& where) {
  constexpr size_t kMinBytes = 64;  // stamp, empty names, seven numbers
  MessageReader m(bytes, serialization, where);
  std::vector<TransformMessage> transforms(m.length(kMinBytes));
  for (TransformMessage& t : transforms) {
    t.header = m.header();
    t.child_frame = without_slash(m.text());
    t.T = m.pose();
  }
  return transforms;
}

}  // namespace edgevo
