// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Conversion of cameras and poses from and to OpenCV's matrices of doubles.
#include <opencv2/core.hpp>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// The matrix K of a pinhole.
inline cv::Mat camera_matrix(const Pinhole& p) {
  return (cv::Mat_<double>(3, 3) << p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1);
}

/// A vector of three rows.
inline Eigen::Vector3d to_vector(const cv::Mat& t) {
  return {t.at<double>(0), t.at<double>(1), t.at<double>(2)};
}

/// Pose from a rotation matrix `R` and a translation `t`.
inline SE3 to_se3(const cv::Mat& R, const Eigen::Vector3d& t) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = R.at<double>(i / 3, i % 3);
  return {rotation, t};
}

}  // namespace edgevo
