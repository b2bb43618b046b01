// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Camera models: where a lens shows the light that arrives from a direction, in pixels of the raw image.
//
// To add a model:
//   1. Below, a struct that begins with Intrinsics and holds the coefficients, with project, unproject,
//      jacobian and max_angle as documented at PinholeModel; formulas in core/src/camera_models.cpp. A ray
//      may point anywhere, also behind the image plane: look at its angle before dividing by z.
//   2. Its name in CameraModel. The compiler then lists the places that have to know each model: whether its
//      coefficients are finite, and its plumb-bob coefficients, if it has some (core/src/camera.cpp).
//   3. One line in tests/support/camera_examples.h. Round trips, Jacobian, range and rectification of the new
//      model are then tested with those of all others.
//   4. The formats that can hold it: camera files (datasets/src/camera_yaml.cpp, camera_yaml_text.cpp),
//      summary.yaml (results/src/summary/camera_part.cpp), MRPT's and ViSP's cameras (conversions.cpp of each
//      bridge). Formats that cannot must refuse it.
// Edges, tracking and map see none of this: they work in the pinhole of a Rectification
// (core/rectification.h).
#include <Eigen/Core>
#include <optional>
#include <variant>

namespace edgevo {

/// What all models have in common, pixels.
struct Intrinsics {
  /// Focal lengths and principal point. On the axis all models agree with the pinhole of these.
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

/// Derivative of a pixel by the ray that it shows.
using PixelJacobian = Eigen::Matrix<double, 2, 3>;

/// Pinhole without distortion.
struct PinholeModel : Intrinsics {
  /// Raw pixel of a point in the camera frame, or of a ray of any length. Nullopt where the formula is not
  /// defined. Pixels beyond max_angle() are not unique.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// Ray, of any length, that a raw pixel shows: the inverse of project() to 1e-12. Nullopt if there is none
  /// within max_angle().
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// Derivative of project(), 2 x 3, at a ray that it is defined for. It maps the ray itself to zero.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// Largest angle between optical axis and ray, radians, below which the model is one-to-one.
  double max_angle() const;
};

/// Plumb-bob coefficients: x_d = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + tangential(p1, p2), as OpenCV and MRPT
/// define them.
struct Distortion {
  /// Coefficients as in OpenCV: radial k1, k2, k3, tangential p1, p2.
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  /// Whether all coefficients are zero.
  bool is_zero() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
};

/// Pinhole with plumb-bob distortion.
struct PlumbBobModel : Intrinsics {
  /// Distortion of normalised coordinates (X/Z, Y/Z).
  Distortion distortion;

  /// As PinholeModel::project.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// As PinholeModel::unproject.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// As PinholeModel::jacobian.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// Where the radial polynomial, less what the tangential terms may take away, has a slope of a thousandth:
  /// a little before it folds over; at most 90 degrees. Cost: about a microsecond.
  double max_angle() const;
};

/// One of the models.
using CameraModel = std::variant<PinholeModel, PlumbBobModel>;

}  // namespace edgevo
