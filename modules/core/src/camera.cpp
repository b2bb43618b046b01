// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/camera.h"

#include <cmath>
#include <iterator>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

// Plausible focal lengths, pixels: 1 is a view of 180 degrees, a million a telescope.
constexpr double kShortestFocal = 1, kLongestFocal = 1e6;

// Plumb-bob coefficients of the models that have some.
std::optional<Distortion> plumb_bob_of(const PinholeModel& /*model*/) { return Distortion(); }
std::optional<Distortion> plumb_bob_of(const PlumbBobModel& model) { return model.distortion; }
template <class OtherModel>
std::optional<Distortion> plumb_bob_of(const OtherModel& /*model*/) {
  return std::nullopt;
}

using Coefficients = std::vector<std::pair<std::string, double>>;

Coefficients coefficients(const PinholeModel& /*model*/) { return {}; }
Coefficients coefficients(const Distortion& d) {
  return {{"k1", d.k1}, {"k2", d.k2}, {"p1", d.p1}, {"p2", d.p2}, {"k3", d.k3}};
}
Coefficients coefficients(const PlumbBobModel& m) { return coefficients(m.distortion); }
Coefficients coefficients(const RationalModel& m) {
  const RationalDistortion& d = m.distortion;
  Coefficients all = coefficients(d.plumb_bob);
  for (const auto& c : Coefficients{
           {"k4", d.k4}, {"k5", d.k5}, {"k6", d.k6}, {"s1", d.s1}, {"s2", d.s2}, {"s3", d.s3}, {"s4", d.s4}})
    all.push_back(c);
  return all;
}
Coefficients coefficients(const KannalaBrandtModel& m) {
  return {{"k1", m.k1}, {"k2", m.k2}, {"k3", m.k3}, {"k4", m.k4}};
}
Coefficients coefficients(const FovModel& m) { return {{"omega", m.omega}}; }
Coefficients coefficients(const ExtendedUnifiedModel& m) { return {{"alpha", m.alpha}, {"beta", m.beta}}; }
Coefficients coefficients(const DoubleSphereModel& m) { return {{"xi", m.xi}, {"alpha", m.alpha}}; }
Coefficients coefficients(const OmniModel& m) {
  Coefficients all{{"xi", m.xi}};
  for (const auto& c : coefficients(m.distortion)) all.push_back(c);
  return all;
}

double sum(const Distortion& d) { return d.k1 + d.k2 + d.p1 + d.p2 + d.k3; }

// What is wrong with the coefficients of a model, with what is right; empty: nothing.
std::string problem(const PinholeModel& /*model*/) { return {}; }
std::string problem(const PlumbBobModel& m) {
  return std::isfinite(sum(m.distortion)) ? "" : "k1 k2 p1 p2 k3 must be numbers";
}
std::string problem(const RationalModel& m) {
  const RationalDistortion& d = m.distortion;
  return std::isfinite(sum(d.plumb_bob) + d.k4 + d.k5 + d.k6 + d.s1 + d.s2 + d.s3 + d.s4)
             ? ""
             : "k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 must be numbers";
}
std::string problem(const KannalaBrandtModel& m) {
  return std::isfinite(m.k1 + m.k2 + m.k3 + m.k4) ? "" : "k1 k2 k3 k4 must be numbers";
}
std::string problem(const FovModel& m) {
  return m.omega > 0 && m.omega < M_PI ? "" : "omega must lie between 0 and pi";
}
std::string problem(const ExtendedUnifiedModel& m) {
  const bool right = m.alpha >= 0 && m.alpha <= 1 && m.beta > 0 && std::isfinite(m.beta);
  return right ? "" : "alpha must lie between 0 and 1, beta above 0";
}
std::string problem(const DoubleSphereModel& m) {
  const bool right = m.alpha >= 0 && m.alpha <= 1 && m.xi > -1 && std::isfinite(m.xi);
  return right ? "" : "alpha must lie between 0 and 1, xi above -1";
}
std::string problem(const OmniModel& m) {
  const bool right = m.xi >= 0 && std::isfinite(m.xi + sum(m.distortion));
  return right ? "" : "xi must not be negative, and k1 k2 p1 p2 must be numbers";
}

}  // namespace

const char* to_string(const CameraModel& model) {
  static constexpr const char* kNames[] = {"pinhole", "plumb_bob",        "rational",      "kannala_brandt",
                                           "fov",     "extended_unified", "double_sphere", "omni"};
  static_assert(std::size(kNames) == std::variant_size_v<CameraModel>);
  return kNames[model.index()];
}

std::vector<std::pair<std::string, double>> coefficients_of(const CameraModel& model) {
  return std::visit([](const auto& m) { return coefficients(m); }, model);
}

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

std::optional<Distortion> Camera::plumb_bob() const {
  return std::visit([](const auto& m) { return plumb_bob_of(m); }, model);
}

Distortion Camera::distortion() const {
  if (const auto coefficients = plumb_bob()) return *coefficients;
  throw InputError("camera", std::string("its lens (") + to_string(model) + ") has no plumb-bob coefficients",
                   "use a format that knows the lens, or rectified images");
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
    throw InputError(where,
                     "the principal point lies outside the image: (" + fixed(p.cx, 1) + ", " +
                         fixed(p.cy, 1) + ") in " + std::to_string(p.width) + "x" + std::to_string(p.height) +
                         " pixels",
                     "give cx cy in pixels, and the size of the images");
  const std::string wrong = std::visit([](const auto& m) { return problem(m); }, model);
  if (!wrong.empty())
    throw InputError(where, std::string("the lens (") + to_string(model) + ") has an impossible coefficient",
                     wrong);
}

}  // namespace edgevo
