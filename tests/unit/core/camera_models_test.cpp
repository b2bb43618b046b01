// SPDX-License-Identifier: BSD-3-Clause
// What every camera model promises, over its whole angle.
#include "edgevo/core/camera_models.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/camera_examples.h"
#include "support/numerical_jacobian.h"
#include "support/pose_matchers.h"

namespace edgevo {
namespace {

using Vector2d = Eigen::Vector2d;
using Vector3d = Eigen::Vector3d;

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

Vector3d ray_at(double angle, double azimuth) {
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

class EachCameraModel : public ::testing::TestWithParam<test::CameraExample> {
 protected:
  const Camera& camera() const { return GetParam().camera; }
  // Unit rays from the axis up to `share` of the model's angle.
  std::vector<Vector3d> rays(double share = 0.9999) const {
    constexpr int kSteps = 60, kAzimuths = 24;
    const double angle = share * camera().max_angle();
    std::vector<Vector3d> all;
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; k < kAzimuths; ++k) all.push_back(ray_at(angle * i / kSteps, 2 * M_PI * k / kAzimuths));
    return all;
  }
  // Relative to the focal length, or to the distance from the principal point where that is larger.
  double relative_error(const Vector2d& px, const Vector2d& expected) const {
    const Pinhole p = camera().pinhole();
    const double size = std::max(std::min(p.fx, p.fy), (expected - Vector2d(p.cx, p.cy)).norm());
    return (px - expected).norm() / size;
  }
};

TEST_P(EachCameraModel, ReturnsEveryRayOfItsAngle) {
  for (const Vector3d& ray : rays()) {
    const auto px = camera().project(3.7 * ray);
    ASSERT_TRUE(px) << ray.transpose();
    const auto back = camera().unproject(*px);
    ASSERT_TRUE(back) << ray.transpose();
    EXPECT_LT(angle_between(*back, ray), 1e-10) << ray.transpose();
  }
}

TEST_P(EachCameraModel, ReturnsEveryPixelOfItsAngle) {
  for (const Vector3d& ray : rays()) {
    const Vector2d px = camera().project(ray).value() + Vector2d(1e-7, -1e-7);
    const auto back = camera().unproject(px);
    if (!back) continue;  // just beyond the last ray
    EXPECT_LT(relative_error(camera().project(*back).value(), px), 1e-10) << px.transpose();
  }
}

// Over an area three times as wide as the image.
TEST_P(EachCameraModel, GivesNoRayBeyondItsAngle) {
  const double max_angle = camera().max_angle();
  for (double v = -1; v <= 2; v += 0.05)
    for (double u = -1; u <= 2; u += 0.05) {
      const Vector2d px(u * camera().width, v * camera().height);
      const auto ray = camera().unproject(px);
      if (!ray) continue;
      EXPECT_LE(angle_between(*ray, Vector3d::UnitZ()), max_angle + 1e-9) << px.transpose();
      EXPECT_LT(relative_error(camera().project(*ray).value(), px), 1e-10) << px.transpose();
    }
}

TEST_P(EachCameraModel, IsOneToOneWithinItsAngle) {
  const double max_angle = camera().max_angle();
  const Pinhole p = camera().pinhole();
  for (int k = 0; k < 24; ++k) {
    double last = -1;
    for (int i = 0; i < 500; ++i) {
      const Vector3d ray = ray_at(max_angle * i / 500, 2 * M_PI * k / 24);
      const Vector2d px = camera().project(ray).value();
      const double radius = Vector2d((px.x() - p.cx) / p.fx, (px.y() - p.cy) / p.fy).norm();
      EXPECT_GT(radius, last) << k << " " << i;
      last = radius;
    }
  }
}

TEST_P(EachCameraModel, HasTheJacobianOfItsProjection) {
  for (const Vector3d& unit : rays(0.95)) {
    const Vector3d ray = 1.8 * unit;
    const auto moved = [&](const Vector3d& d) -> Vector2d { return camera().project(ray + d).value(); };
    const PixelJacobian J = camera().jacobian(ray);
    EXPECT_THAT(J, test::JacobianNear(test::numerical_jacobian<3>(moved), 1e-6)) << ray.transpose();
    EXPECT_LT((J * ray).norm(), 1e-9 * J.norm()) << "the length of a ray does not matter";
  }
}

TEST_P(EachCameraModel, AgreesWithThePinholeOnTheAxis) {
  const Pinhole p = camera().pinhole();
  const Vector2d px = camera().project({0, 0, 2}).value();
  EXPECT_EQ(px, Vector2d(p.cx, p.cy));
  PixelJacobian expected;
  expected << p.fx, 0, 0, 0, p.fy, 0;
  EXPECT_LT((camera().jacobian({0, 0, 1}) - expected).norm(), 1e-12);
}

TEST_P(EachCameraModel, ShowsNothingThatIsBehindIt) {
  EXPECT_FALSE(camera().project({0, 0, -1}));
  EXPECT_FALSE(camera().project({0, 0, 0}));
}

INSTANTIATE_TEST_SUITE_P(CameraModels, EachCameraModel, ::testing::ValuesIn(test::camera_examples()),
                         test::name_of);

}  // namespace
}  // namespace edgevo
