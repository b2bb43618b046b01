// SPDX-License-Identifier: BSD-3-Clause
// Messages in each serialization, and cut off.
#include "edgevo/recordings/messages.h"

#include <gmock/gmock.h>

#include "support/recording_messages.h"

namespace edgevo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int64_t kStampNs = 1'600'000'000'123'456'700;

Serialization read_as(Wire wire) { return wire == Wire::kRos1 ? Serialization::kRos1 : Serialization::kCdr; }

template <class Check>
void in_each_wire(const Check& check) {
  for (const Wire wire : {Wire::kRos1, Wire::kCdrLittle, Wire::kCdrBig}) {
    SCOPED_TRACE(int(wire));
    check(wire, read_as(wire));
  }
}

void expect_header(const MessageHeader& header, const std::string& frame) {
  EXPECT_EQ(header.stamp.ticks, kStampNs / 100);
  EXPECT_EQ(header.frame, frame);
}

TEST(Messages, Image) {
  in_each_wire([](Wire wire, Serialization serialization) {
    TestImage image{3, 2, "rgb8", "123456789abcdefghi", 9};
    image.is_big_endian = true;
    image.frame = "/cam";
    const std::string bytes = image_message(wire, kStampNs, image);
    const ImageMessage m = decode_image(bytes, serialization, "x");
    expect_header(m.header, "cam");
    EXPECT_EQ(m.width, 3);
    EXPECT_EQ(m.height, 2);
    EXPECT_EQ(m.encoding, "rgb8");
    EXPECT_TRUE(m.is_big_endian);
    EXPECT_EQ(m.step, 9u);
    EXPECT_EQ(m.pixels, image.data);
    expect_header(decode_header(bytes.substr(0, 40), serialization, "x"), "cam");
  });
}

TEST(Messages, CompressedImage) {
  in_each_wire([](Wire wire, Serialization serialization) {
    const std::string bytes = compressed_message(wire, kStampNs, "jpeg", "whole file");
    const CompressedImageMessage m = decode_compressed_image(bytes, serialization, "x");
    expect_header(m.header, "cam0_optical");
    EXPECT_EQ(m.format, "jpeg");
    EXPECT_EQ(m.file, "whole file");
  });
}

TEST(Messages, CameraInfo) {
  in_each_wire([](Wire wire, Serialization serialization) {
    TestCameraInfo info;
    info.width = 640, info.height = 480, info.D = {0.1, 0.2, 0.3, 0.4, 0.5};
    info.K = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    info.P[3] = -7;
    info.binning_x = 2, info.binning_y = 3, info.roi_x = 4, info.roi_y = 5, info.roi_height = 6,
    info.roi_width = 7;
    const std::string bytes = camera_info_message(wire, kStampNs, info);
    const CameraInfoMessage m = decode_camera_info(bytes, serialization, "x");
    EXPECT_EQ(m.width, 640);
    EXPECT_EQ(m.height, 480);
    EXPECT_EQ(m.distortion_model, "plumb_bob");
    EXPECT_EQ(m.D, info.D);
    EXPECT_THAT(m.K, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
    EXPECT_EQ(m.P[3], -7);
    EXPECT_EQ(m.binning_x, 2u);
    EXPECT_EQ(m.binning_y, 3u);
    EXPECT_EQ(m.roi_x, 4u);
    EXPECT_EQ(m.roi_y, 5u);
    EXPECT_EQ(m.roi_height, 6u);
    EXPECT_EQ(m.roi_width, 7u);
  });
}

TEST(Messages, Sensors) {
  in_each_wire([](Wire wire, Serialization serialization) {
    const std::string odometry = odometry_message(wire, kStampNs, {1, 2, 3}, {0, 0, 1, 0}, "/base");
    const OdometryMessage o = decode_odometry(odometry, serialization, "x");
    expect_header(o.header, "odom");
    EXPECT_EQ(o.child_frame, "base");
    EXPECT_EQ(o.pose.translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(o.pose.rotation().z(), 1);
    EXPECT_EQ(o.linear, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(o.angular, Eigen::Vector3d(4, 5, 6));
    const std::string fix = nav_sat_fix_message(wire, kStampNs, 0, {43, 6, 150});
    const NavSatFixMessage f = decode_nav_sat_fix(fix, serialization, "x");
    EXPECT_TRUE(f.has_fix);
    EXPECT_EQ(f.latitude_deg, 43);
    EXPECT_EQ(f.longitude_deg, 6);
    EXPECT_EQ(f.altitude_m, 150);
    const std::string none = nav_sat_fix_message(wire, kStampNs, -1, {43, 6, 150});
    EXPECT_FALSE(decode_nav_sat_fix(none, serialization, "x").has_fix);
    const std::string imu = imu_message(wire, kStampNs, {0, 0, 0, 1});
    const ImuMessage i = decode_imu(imu, serialization, "x");
    EXPECT_EQ(i.angular_velocity, Eigen::Vector3d(0.1, 0.2, 0.3));
    EXPECT_EQ(i.acceleration, Eigen::Vector3d(1, 2, 9.8));
    EXPECT_EQ(i.orientation_xyzw[3], 1);
    const std::string pose = pose_message(wire, kStampNs, {4, 5, 6}, {1, 0, 0, 0});
    EXPECT_EQ(decode_pose(pose, serialization, "x").pose.translation(), Eigen::Vector3d(4, 5, 6));
  });
}

TEST(Messages, Transforms) {
  in_each_wire([](Wire wire, Serialization serialization) {
    const std::string bytes = transforms_message(
        wire, {{"/a", "/bc", {1, 2, 3}, {0, 0, 0, 1}}, {"bc", "d", {4, 5, 6}, {0, 0, 0, 0}}});
    const auto transforms = decode_transforms(bytes, serialization, "x");
    ASSERT_EQ(transforms.size(), 2u);
    EXPECT_EQ(transforms[0].header.frame, "a");
    EXPECT_EQ(transforms[0].child_frame, "bc");
    EXPECT_EQ(transforms[1].T.translation(), Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(transforms[1].T.rotation().w(), 1);
  });
}

TEST(Messages, EndInAFieldIsAnError) {
  in_each_wire([](Wire wire, Serialization serialization) {
    const std::string bytes = image_message(wire, kStampNs, {3, 2, "mono8", "123456", 3});
    for (size_t size = 0; size < bytes.size(); ++size)
      EXPECT_THROW(decode_image(std::string_view(bytes).substr(0, size), serialization, "x"), InputError)
          << size;
  });
}

TEST(Messages, OtherSerializationsAreRefused) {
  const std::string bytes = image_message(Wire::kCdrLittle, kStampNs, {3, 2, "mono8", "123456", 3});
  EXPECT_THROW(decode_image(bytes, Serialization::kOther, "x"), InputError);
  try {
    decode_image(std::string("\0\3\0\0", 4) + bytes.substr(4), Serialization::kCdr, "here");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("here: the message is damaged: its CDR is of kind 3"));
  }
}

}  // namespace
}  // namespace edgevo::test
