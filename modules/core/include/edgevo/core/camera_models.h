// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Camera models: where a lens shows the light that arrives from a direction, in pixels of the raw image.
//
// To add a model:
//   1. Below, a struct that begins with Intrinsics and holds the coefficients, with project, unproject,
//      jacobian and max_angle as documented at PinholeModel; formulas in core/src/camera_models/. A ray
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

/// Coefficients of OpenCV's rational model with thin prism:
/// x_d = x (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6) + tangential(p1, p2)
///       + (s1 r^2 + s2 r^4, s3 r^2 + s4 r^4).
struct RationalDistortion {
  /// Radial coefficients of the numerator and tangential ones, as plumb-bob.
  Distortion plumb_bob;
  /// Radial coefficients of the denominator.
  double k4 = 0, k5 = 0, k6 = 0;
  /// Thin prism.
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0;
};

/// Pinhole with rational distortion: 8 to 12 coefficients, for wide angles below 180 degrees.
struct RationalModel : Intrinsics {
  /// Distortion of normalised coordinates (X/Z, Y/Z).
  RationalDistortion distortion;

  /// As PinholeModel::project.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// As PinholeModel::unproject.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// As PinholeModel::jacobian.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// As PlumbBobModel::max_angle, or where the slope exceeds a thousand before a pole. Cost: about five
  /// microseconds.
  double max_angle() const;
};

/// Fisheye of Kannala and Brandt (2006) with four terms: a ray at angle t to the axis appears at the distance
/// t (1 + k1 t^2 + k2 t^4 + k3 t^6 + k4 t^8) from the principal point, normalised. OpenCV's fisheye, Kalibr's
/// `equidistant`, ORB-SLAM's KannalaBrandt8.
struct KannalaBrandtModel : Intrinsics {
  /// Coefficients.
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0;

  /// As PinholeModel::project.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// As PinholeModel::unproject.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// As PinholeModel::jacobian.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// Where the polynomial has a slope of a thousandth; at most 180 degrees. Cost: about a microsecond.
  double max_angle() const;
};

/// Lens of Devernay and Faugeras (2001), "FOV" or ATAN: distance atan(2 tan(omega/2) tan t) / (2
/// tan(omega/2)) at the angle t, continued beyond 90 degrees. Files state the focal length of the distorted
/// image, f omega / (2 tan(omega/2)) here.
struct FovModel : Intrinsics {
  /// Angle of the lens, radians, 0 to pi, exclusive.
  double omega = 1;

  /// As PinholeModel::project.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// As PinholeModel::unproject.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// As PinholeModel::jacobian.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// 180 degrees, less a little.
  double max_angle() const;
};

/// Enhanced unified model (Khomutenko et al. 2016): (X, Y) / (alpha d + (1 - alpha) Z),
/// d = sqrt(beta (X^2 + Y^2) + Z^2). With beta 1 the unified model (UCM).
struct ExtendedUnifiedModel : Intrinsics {
  /// 0 (pinhole) to 1.
  double alpha = 0;
  /// Above 0.
  double beta = 1;

  /// As PinholeModel::project.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// As PinholeModel::unproject.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// As PinholeModel::jacobian.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// Where the denominator vanishes or the image folds over.
  double max_angle() const;
};

/// Double sphere model (Usenko et al. 2018): (X, Y) (1 + xi) / (alpha d2 + (1 - alpha) (xi d1 + Z)),
/// d1 = |(X, Y, Z)|, d2 = |(X, Y, xi d1 + Z)|. Files state the focal length f (1 + xi).
struct DoubleSphereModel : Intrinsics {
  /// Distance of the second sphere, above -1.
  double xi = 0;
  /// 0 to 1.
  double alpha = 0;

  /// As PinholeModel::project.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// As PinholeModel::unproject.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// As PinholeModel::jacobian.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// Where the denominator vanishes or the image folds over.
  double max_angle() const;
};

/// Omnidirectional camera of Mei and Rives (2007): plumb-bob distortion of (X, Y) / (Z + xi d),
/// d = |(X, Y, Z)|. OpenCV's omnidir, Kalibr's `omni`. Files state the focal length f (1 + xi).
struct OmniModel : Intrinsics {
  /// Distance of the centre of projection from that of the sphere, 0 (pinhole) or more.
  double xi = 0;
  /// Distortion; k3 is unused by files.
  Distortion distortion;

  /// As PinholeModel::project.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& ray) const;
  /// As PinholeModel::unproject.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& px) const;
  /// As PinholeModel::jacobian.
  PixelJacobian jacobian(const Eigen::Vector3d& ray) const;
  /// Where the sphere's image or the distortion folds over. Cost: about two microseconds.
  double max_angle() const;
};

/// One of the models.
using CameraModel = std::variant<PinholeModel, PlumbBobModel, RationalModel, KannalaBrandtModel, FovModel,
                                 ExtendedUnifiedModel, DoubleSphereModel, OmniModel>;

/// Name of the model in files and messages: "pinhole", "plumb_bob", "rational", "kannala_brandt", "fov",
/// "extended_unified", "double_sphere", "omni".
const char* to_string(const CameraModel& model);

}  // namespace edgevo
