// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/camera.h"

#include <cmath>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

// Plausible focal lengths, pixels: 1 is a view of 180 degrees, a million a telescope.
constexpr double kShortestFocal = 1, kLongestFocal = 1e6;

Distortion coefficients(const PinholeModel& /*model*/) { return {}; }
Distortion coefficients(const PlumbBobModel& model) { return model.distortion; }

bool is_finite(const PinholeModel& /*model*/) { return true; }
bool is_finite(const PlumbBobModel& model) {
  const Distortion& d = model.distortion;
  return std::isfinite(d.k1 + d.k2 + d.p1 + d.p2 + d.k3);
}

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

Camera::Camera(const Pinhole& p, const Distortion& distortion) : width(p.width), height(p.height) {
  const Intrinsics intrinsics{p.fx, p.fy, p.cx, p.cy};
  if (distortion.is_zero())
    model = PinholeModel{intrinsics};
  else
    model = PlumbBobModel{intrinsics, distortion};
}

Pinhole Camera::pinhole() const {
  const Intrinsics i = std::visit([](const Intrinsics& m) { return m; }, model);
  return {i.fx, i.fy, i.cx, i.cy, width, height};
}

void Camera::set_pinhole(const Pinhole& p) {
  std::visit([&](Intrinsics& m) { m = {p.fx, p.fy, p.cx, p.cy}; }, model);
  width = p.width, height = p.height;
}

Distortion Camera::distortion() const {
  return std::visit([](const auto& m) { return coefficients(m); }, model);
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& ray) const {
  return std::visit([&](const auto& m) { return m.project(ray); }, model);
}

std::optional<Eigen::Vector3d> Camera::unproject(const Eigen::Vector2d& px) const {
  return std::visit([&](const auto& m) { return m.unproject(px); }, model);
}

PixelJacobian Camera::jacobian(const Eigen::Vector3d& ray) const {
  return std::visit([&](const auto& m) { return m.jacobian(ray); }, model);
}

double Camera::max_angle() const {
  return std::visit([](const auto& m) { return m.max_angle(); }, model);
}

void Camera::check(const std::string& where) const {
  const Pinhole p = pinhole();
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
  if (!std::visit([](const auto& m) { return is_finite(m); }, model))
    throw InputError(where, "a distortion coefficient is not a number", "give k1 k2 p1 p2 k3");
}

}  // namespace edgevo
