// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The camera that takes the images (Camera), the pinhole in which the odometry works (Pinhole), and the
// correction between both that a run may find (ImageCorrection).
//
// Frames: camera x right, y down, z forward. Pixel (0,0) is the CENTRE of the top-left pixel. A point (X,Y,Z)
// in front of the camera has the normalised coordinates x = (X/Z, Y/Z); a pinhole shows it at u = fx x + cx,
// v = fy y + cy, a lens elsewhere (camera_models.h).
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera_models.h"

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
  /// Exact comparison.
  bool operator==(const Pinhole& o) const {
    return fx == o.fx && fy == o.fy && cx == o.cx && cy == o.cy && width == o.width && height == o.height;
  }
};

/// The coefficients of a lens by the names of its fields, in their order; none for a pinhole.
std::vector<std::pair<std::string, double>> coefficients_of(const CameraModel& model);

/// The camera that takes the images, as its file describes it: size and lens of the raw images. The method
/// works in the pinhole of a Rectification (rectification.h).
struct Camera {
  /// Lens and sensor.
  CameraModel model;
  /// Size of the raw images, pixels.
  int width = 0, height = 0;

  Camera() = default;
  /// Pinhole with plumb-bob distortion; PinholeModel if it is zero.
  Camera(const Pinhole& pinhole, const Distortion& distortion = {});

  /// Focal lengths, principal point and size, without the distortion.
  Pinhole pinhole() const;
  /// Changes focal lengths, principal point and size; the lens stays as it is.
  void set_pinhole(const Pinhole& pinhole);
  /// Plumb-bob coefficients, zero for a pinhole; nullopt for a model that has none.
  std::optional<Distortion> plumb_bob() const;
  /// The same; throws InputError for a model that has none.
  Distortion distortion() const;
  /// Replaces the model by plumb-bob, or by a pinhole if all coefficients are zero.
  void set_distortion(const Distortion& distortion) { *this = Camera(pinhole(), distortion); }
  /// Whether the raw images are distorted.
  bool has_distortion() const { return !std::holds_alternative<PinholeModel>(model); }

  /// Raw pixel of a point or ray in the camera frame (PinholeModel::project).
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// Ray of a raw pixel, of any length; nullopt outside the range of the model (PinholeModel::unproject).
  [[nodiscard]] std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// Derivative of project().
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// Angle from the optical axis, radians, below which the model is one-to-one.
  double max_angle() const;

  /// Throws InputError naming `where` when sizes or focal lengths are not positive, the principal point lies
  /// outside the image or a value is not finite.
  void check(const std::string& where) const;
};

/// Image correction that camera files do not contain, estimated during a run or given. Its effect on points:
/// edges/image_correction.h.
struct ImageCorrection {
  /// Residual radial coefficient (radial.h); acts on the true image point, before the lens of the file.
  double k1 = 0;
  /// Read-out time from the first row to the last, seconds; negative: read from bottom to top.
  double readout_s = 0;
  /// True focal length over that of the file, less 1.
  double focal = 0;

  /// Whether the lens is that of the file.
  bool keeps_lens() const { return k1 == 0 && focal == 0; }
  /// Exact comparison of the lens alone.
  bool has_lens_of(const ImageCorrection& o) const { return k1 == o.k1 && focal == o.focal; }
  /// Exact comparison.
  bool operator==(const ImageCorrection& o) const { return has_lens_of(o) && readout_s == o.readout_s; }
  /// Exact comparison.
  bool operator!=(const ImageCorrection& o) const { return !(*this == o); }
};

}  // namespace edgevo
