// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/camera.h"

#include <Eigen/LU>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/radial.h"

namespace edgevo {
namespace {

// Newton's method on the lens model, normalised coordinates.
constexpr int kMostSteps = 30;  // more than any point within the model's range needs
// Step at which it has converged: the documented 1e-12, with a margin.
constexpr double kErrorSquare = 1e-26;
// Determinant of the derivative, 1 on the axis; below it the point is beyond the model's range.
constexpr double kFoldedOver = 1e-6;
// Tolerated error of the inverse: a millionth of a pixel at a focal length of 1000 px.
constexpr double kInverseError = 1e-9;
// Plausible focal lengths, pixels: 1 is a view of 180 degrees, a million a telescope.
constexpr double kShortestFocal = 1, kLongestFocal = 1e6;

}  // namespace

Pinhole Pinhole::at_level(int level) const {
  Pinhole p = *this;
  const double s = std::ldexp(1.0, -level);
  p.fx *= s, p.fy *= s, p.cx *= s, p.cy *= s;
  for (int l = 0; l < level; ++l) {
    p.width = (p.width + 1) / 2;
    p.height = (p.height + 1) / 2;
  }
  return p;
}

Eigen::Vector2d Camera::distort(const Eigen::Vector2d& x_true) const {
  const Eigen::Vector2d x = add_radial(residual_k1, x_true);
  const Distortion& d = distortion;
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double xy = x.x() * x.y();
  return {x.x() * radial + 2.0 * d.p1 * xy + d.p2 * (r2 + 2.0 * x.x() * x.x()),
          x.y() * radial + d.p1 * (r2 + 2.0 * x.y() * x.y()) + 2.0 * d.p2 * xy};
}

bool Camera::undistort(const Eigen::Vector2d& x_distorted, Eigen::Vector2d* x) const {
  const Distortion& d = distortion;
  const Camera by_file{pinhole, distortion, 0.0};
  Eigen::Vector2d p = x_distorted;
  for (int iteration = 0; iteration < kMostSteps; ++iteration) {
    const Eigen::Vector2d error = by_file.distort(p) - x_distorted;
    if (error.squaredNorm() < kErrorSquare) break;
    const double r2 = p.squaredNorm();
    const double radial = 1.0 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
    const double dradial = 2.0 * (d.k1 + r2 * (2.0 * d.k2 + r2 * 3.0 * d.k3));  // d radial / d (r2/2)
    Eigen::Matrix2d J;
    J(0, 0) = radial + p.x() * p.x() * dradial + 2.0 * d.p1 * p.y() + 6.0 * d.p2 * p.x();
    J(0, 1) = p.x() * p.y() * dradial + 2.0 * d.p1 * p.x() + 2.0 * d.p2 * p.y();
    J(1, 0) = J(0, 1);
    J(1, 1) = radial + p.y() * p.y() * dradial + 6.0 * d.p1 * p.y() + 2.0 * d.p2 * p.x();
    const double det = J.determinant();
    if (!(det > kFoldedOver)) return false;
    p -= J.inverse() * error;
  }
  *x = remove_radial(residual_k1, p);
  return (distort(*x) - x_distorted).norm() < kInverseError;
}

void Camera::check(const std::string& where) const {
  const Pinhole& p = pinhole;
  if (p.width <= 0 || p.height <= 0)
    throw InputError(
        where, "image size " + std::to_string(p.width) + "x" + std::to_string(p.height) + " is not positive",
        "give width and height in pixels");
  if (!(p.fx > 0) || !(p.fy > 0) || !std::isfinite(p.fx) || !std::isfinite(p.fy))
    throw InputError(where, "focal lengths must be positive numbers", "give fx fy in pixels");
  for (const double f : {p.fx, p.fy})
    if (f < kShortestFocal || f > kLongestFocal)
      throw InputError(where, "a focal length is below one pixel or above a million",
                       "give fx fy in pixels, not in millimetres or as shares of the width");
  if (!(p.cx > 0 && p.cx < p.width && p.cy > 0 && p.cy < p.height))
    throw InputError(where, "the principal point lies outside the image", "give cx cy in pixels");
  const Distortion& d = distortion;
  for (double k : {d.k1, d.k2, d.p1, d.p2, d.k3})
    if (!std::isfinite(k))
      throw InputError(where, "a distortion coefficient is not a number", "give k1 k2 p1 p2 k3");
}

UndistortionMaps make_undistortion_maps(const Camera& camera) {
  const Pinhole& p = camera.pinhole;
  UndistortionMaps maps{p.width, p.height, {}, {}};
  maps.x.reserve(size_t(p.width) * p.height);
  maps.y.reserve(size_t(p.width) * p.height);
  for (int v = 0; v < p.height; ++v)
    for (int u = 0; u < p.width; ++u) {
      const Eigen::Vector2d d = camera.distort(p.ray({double(u), double(v)}).head<2>());
      maps.x.push_back(float(p.fx * d.x() + p.cx));
      maps.y.push_back(float(p.fy * d.y() + p.cy));
    }
  return maps;
}

}  // namespace edgevo
