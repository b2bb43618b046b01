// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small folders of both releases of Virtual KITTI, for tests of their reader.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/se3.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo::test {

constexpr int kVirtualKittiFrames = 3;

inline SE3 virtual_kitti_pose(int frame) {  // T_world_cam
  return {Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * frame, Eigen::Vector3d::UnitY())),
          Eigen::Vector3d(0.5 * frame, 0.1, 2.0 * frame)};
}

inline std::string virtual_kitti_row(const SE3& T_world_cam) {
  const Eigen::Matrix4d M = T_world_cam.inverse().matrix();  // world to camera
  std::string text;
  char number[32];
  for (int i = 0; i < 16; ++i) {
    std::snprintf(number, sizeof number, " %.12g", M(i / 4, i % 4));
    text += number;
  }
  return text + "\n";
}

inline std::string five_digits(int i) {
  char name[16];
  std::snprintf(name, sizeof name, "%05d", i);
  return name;
}

/// Depth image in centimetres that rises by one a pixel from 500; the last pixel is sky.
inline void write_virtual_kitti_depth(const std::string& path, int width = 24, int height = 16) {
  fs::create_directories(fs::path(path).parent_path());
  cv::Mat depth(height, width, CV_16U);
  for (int i = 0; i < width * height; ++i) depth.at<uint16_t>(i / width, i % width) = uint16_t(500 + i);
  depth.at<uint16_t>(height - 1, width - 1) = 65535;
  cv::imwrite(path, depth);
}

/// Writes a sequence of release 1.3.1: root/vkitti_1.3.1_rgb/0001/15-deg-left with its depth and poses.
inline void write_virtual_kitti_1(const std::string& root) {
  const std::string sequence = root + "/vkitti_1.3.1_rgb/0001/15-deg-left";
  std::string poses = "frame r1,1 r1,2 r1,3 t1 r2,1 r2,2 r2,3 t2 r3,1 r3,2 r3,3 t3 0 0 0 1\n";
  fs::create_directories(sequence);
  for (int i = 0; i < kVirtualKittiFrames; ++i) {
    write_png(sequence + "/" + five_digits(i) + ".png", make_image(i));
    write_virtual_kitti_depth(root + "/vkitti_1.3.1_depthgt/0001/15-deg-left/" + five_digits(i) + ".png");
    poses += std::to_string(i) + virtual_kitti_row(virtual_kitti_pose(i));
  }
  write_text(root + "/vkitti_1.3.1_extrinsicsgt/0001_15-deg-left.txt", poses);
}

/// Writes a sequence of release 2.0.3: two cameras 0.5 m apart in `sequence`.
inline void write_virtual_kitti_2(const std::string& sequence) {
  std::string poses = "frame cameraID r1,1 r1,2 r1,3 t1 r2,1 r2,2 r2,3 t2 r3,1 r3,2 r3,3 t3 0 0 0 1\n";
  std::string intrinsics = "frame cameraID K[0,0] K[1,1] K[0,2] K[1,2]\n";
  for (int i = 0; i < kVirtualKittiFrames; ++i)
    for (int c = 0; c < 2; ++c) {
      const std::string camera = "/Camera_" + std::to_string(c);
      fs::create_directories(sequence + "/frames/rgb" + camera);
      const cv::Mat rgb(16, 24, CV_8UC3, cv::Scalar(40 * i, 100 * c, 90));
      cv::imwrite(sequence + "/frames/rgb" + camera + "/rgb_" + five_digits(i) + ".jpg", rgb);
      write_virtual_kitti_depth(sequence + "/frames/depth" + camera + "/depth_" + five_digits(i) + ".png");
      const SE3 T_cam0_cam(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.5 * c, 0, 0));
      poses +=
          std::to_string(i) + " " + std::to_string(c) + virtual_kitti_row(virtual_kitti_pose(i) * T_cam0_cam);
      intrinsics +=
          std::to_string(i) + " " + std::to_string(c) + " 20.5 21 " + std::to_string(11 + c) + " 7.5\n";
    }
  write_text(sequence + "/extrinsic.txt", poses);
  write_text(sequence + "/intrinsic.txt", intrinsics);
}

}  // namespace edgevo::test
