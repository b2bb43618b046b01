// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/rectification.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/target_pinhole.h"
#include "support/camera_examples.h"

namespace edgevo {
namespace {

// A pinhole of another size that sees `view` times as much of each axis.
Pinhole another(const Pinhole& p, double view, int width, int height) {
  const double x = double(width) / p.width / view, y = double(height) / p.height / view;
  return {p.fx * x, p.fy * y, 0.52 * width, 0.47 * height, width, height};
}

class EachRectification : public ::testing::TestWithParam<test::CameraExample> {
 protected:
  const Camera& camera() const { return GetParam().camera; }
  // Narrower than the camera, about as wide, and much wider.
  std::vector<Pinhole> targets() const {
    const Pinhole p = camera().pinhole();
    return {p, another(p, 0.7, 250, 190), another(p, 1.1, 280, 210), another(p, 3, 333, 150)};
  }
};

TEST_P(EachRectification, ItsMapsAreProjectionsOfTheTargetsRays) {
  for (const Pinhole& target : targets()) {
    const RectificationMaps maps = Rectification(camera(), target).maps();
    ASSERT_EQ(maps.width, target.width);
    ASSERT_EQ(maps.height, target.height);
    ASSERT_EQ(maps.x.size(), size_t(target.width) * target.height);
    ASSERT_EQ(maps.y.size(), maps.x.size());
    for (int v = 0; v < target.height; v += 3)
      for (int u = 0; u < target.width; u += 3) {
        const auto px = camera().project(target.ray({double(u), double(v)}));
        const size_t i = size_t(v * target.width + u);
        ASSERT_EQ(px.has_value(), !std::isnan(maps.x[i]));
        if (!px) continue;
        EXPECT_FLOAT_EQ(maps.x[i], float(px->x()));
        EXPECT_FLOAT_EQ(maps.y[i], float(px->y()));
      }
  }
}

// A pixel has a source exactly where the camera sees the ray: within the angle of the model and the area of
// the raw image, whose pixels reach half a pixel beyond their centres.
TEST_P(EachRectification, MissingIsExactlyWhatTheCameraDoesNotSee) {
  int missing = 0, all = 0, wrong = 0;
  const double max_angle = camera().max_angle();
  for (const Pinhole& target : targets()) {
    const RectificationMaps maps = Rectification(camera(), target).maps();
    for (int v = 0; v < target.height; ++v)
      for (int u = 0; u < target.width; ++u) {
        const Eigen::Vector3d ray = target.ray({double(u), double(v)});
        const auto px = camera().project(ray);
        const bool seen = std::atan2(ray.head<2>().norm(), ray.z()) <= max_angle && px && px->x() >= -0.5 &&
                          px->y() >= -0.5 && px->x() <= camera().width - 0.5 &&
                          px->y() <= camera().height - 0.5;
        const bool is_missing = !maps.missing.empty() && maps.missing[size_t(v * target.width + u)] != 0;
        wrong += is_missing == seen, missing += is_missing, ++all;
      }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(missing, 0) << "the wide target reaches beyond the raw image";
  EXPECT_LT(missing, all);
}

TEST_P(EachRectification, PixelsWithASourceShowTheirOwnRay) {
  for (const Pinhole& target : targets()) {
    const Rectification rectification(camera(), target);
    const RectificationMaps maps = rectification.maps();
    for (int v = 0; v < target.height; v += 9)
      for (int u = 0; u < target.width; u += 9) {
        if (!maps.missing.empty() && maps.missing[size_t(v * target.width + u)]) continue;
        const Eigen::Vector3d ray = target.ray({double(u), double(v)});
        const auto back = camera().unproject(rectification.raw_pixel(ray.head<2>()));
        ASSERT_TRUE(back) << u << " " << v;
        EXPECT_LT(std::atan2(back->cross(ray).norm(), back->dot(ray)), 1e-10);
      }
  }
}

TEST_P(EachRectification, WithoutOrWithPlumbBobDistortionTheDefaultKeepsThePinholeAndRepeatsTheBorder) {
  const Rectification rectification(camera());
  if (!camera().plumb_bob()) {
    EXPECT_TRUE(rectification.target() == target_pinhole(camera()));
    return;
  }
  EXPECT_TRUE(rectification.target() == camera().pinhole());
  EXPECT_EQ(rectification.is_identity(), !camera().has_distortion());
  const RectificationMaps maps = rectification.maps();
  const double max_angle = camera().max_angle();
  int wrong = 0;
  for (int v = 0; v < camera().height; ++v)
    for (int u = 0; u < camera().width; ++u) {
      const Eigen::Vector3d ray = camera().pinhole().ray({double(u), double(v)});
      const bool in_range = std::atan2(ray.head<2>().norm(), ray.z()) <= max_angle;
      const bool is_missing = !maps.missing.empty() && maps.missing[size_t(v * camera().width + u)] != 0;
      wrong += is_missing == in_range;
    }
  EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Rectifications, EachRectification, ::testing::ValuesIn(test::camera_examples()),
                         test::name_of);

TEST(Rectification, RefusesAnUnusableTarget) {
  const Camera camera({500, 500, 320, 240, 640, 480});
  Rectification(camera, {400, 400, 280, 210, 560, 420}).check("camera");
  EXPECT_THROW(Rectification(camera, {400, 400, 280, 210, 0, 420}).check("camera"), InputError);
  EXPECT_THROW(Rectification(camera, {0, 400, 280, 210, 560, 420}).check("camera"), InputError);
  EXPECT_THROW(Rectification(Camera({500, 500, 320, 0.4, 640, 1}), {400, 400, 280, 210, 560, 420}).check("c"),
               InputError);
}

}  // namespace
}  // namespace edgevo
