// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Camera model: pinhole with plumb-bob distortion (OpenCV's k1 k2 p1 p2 k3), and maps that undo the
// distortion.
//
// Frames: camera x right, y down, z forward. Pixel (0,0) is the CENTRE of the top-left pixel. A point (X,Y,Z)
// in front of the camera has the normalised coordinates x = (X/Z, Y/Z); distortion acts on these; u = fx x_d
// + cx, v = fy y_d + cy. The odometry works on undistorted images, where only the pinhole part remains.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace edgevo {

/// Pinhole model in pixels, for images of width x height.
struct Pinhole {
  /// Focal lengths and principal point, pixels.
  double fx = 0, fy = 0, cx = 0, cy = 0;
  /// Size of the image, pixels.
  int width = 0, height = 0;

  /// Pixel of a point in front of the camera (z > 0, not checked), camera frame.
  Eigen::Vector2d project(const Eigen::Vector3d& p_cam) const {
    return {fx * p_cam.x() / p_cam.z() + cx, fy * p_cam.y() / p_cam.z() + cy};
  }
  /// Viewing ray (x, y, 1) of a pixel.
  Eigen::Vector3d ray(const Eigen::Vector2d& px) const {
    return {(px.x() - cx) / fx, (px.y() - cy) / fy, 1.0};
  }
  /// Camera of pyramid level `level`: x_l = x_0 / 2^l, sizes rounded up as cv::pyrDown does.
  Pinhole at_level(int level) const;
  /// Whether `px` lies at least `border` pixels inside the image.
  bool contains(const Eigen::Vector2d& px, double border = 0) const {
    return px.x() >= border && px.y() >= border && px.x() <= width - 1 - border &&
           px.y() <= height - 1 - border;
  }
};

/// Plumb-bob coefficients: x_d = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + tangential(p1, p2), as OpenCV and MRPT
/// define them.
struct Distortion {
  /// Coefficients as in OpenCV: radial k1, k2, k3, tangential p1, p2.
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  /// Whether all coefficients are zero.
  bool is_zero() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
};

/// A camera as its file describes it, with the correction found by self-calibration.
struct Camera {
  /// Pinhole intrinsics.
  Pinhole pinhole;
  /// Distortion of the raw images.
  Distortion distortion;
  /// Residual radial coefficient found by self-calibration; acts before `distortion` (radial.h).
  double residual_k1 = 0;

  /// Whether the raw images are distorted at all.
  bool has_distortion() const { return residual_k1 != 0 || !distortion.is_zero(); }
  /// Distorted normalised coordinates of undistorted ones.
  Eigen::Vector2d distort(const Eigen::Vector2d& x) const;
  /// Inverse of distort by Newton steps, to 1e-12 inside the image; returns false where they do not converge.
  [[nodiscard]] bool undistort(const Eigen::Vector2d& x_distorted, Eigen::Vector2d* x) const;
  /// Throws InputError naming `where` when sizes or focal lengths are not positive, the principal point lies
  /// outside the image or a value is not finite.
  void check(const std::string& where) const;
};

/// Image correction that camera files do not contain, estimated during a run or given. Its effect on points:
/// edges/image_correction.h.
struct ImageCorrection {
  /// Residual radial coefficient (radial.h).
  double k1 = 0;
  /// Read-out time from the first row to the last, seconds; negative: read from bottom to top.
  double readout_s = 0;

  /// Exact comparison.
  bool operator==(const ImageCorrection& o) const { return k1 == o.k1 && readout_s == o.readout_s; }
  /// Exact comparison.
  bool operator!=(const ImageCorrection& o) const { return !(*this == o); }
};

/// Lookup tables from each pixel of the undistorted image, row by row, to the distorted one.
struct UndistortionMaps {
  /// Size of both images, pixels.
  int width = 0, height = 0;
  /// Coordinates in the distorted image, width * height of them, pixels.
  std::vector<float> x, y;
};

/// Maps that keep the pinhole part (fx fy cx cy, size) and remove the distortion. Cost: one distort() a
/// pixel.
UndistortionMaps make_undistortion_maps(const Camera& camera);

}  // namespace edgevo
