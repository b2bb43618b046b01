// SPDX-License-Identifier: BSD-3-Clause
// Conversions are lossless both ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/random.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "support/camera_examples.h"

namespace edgevo {
namespace {

TEST(MrptConversions, TimeIsExactToTheTick) {
  for (int64_t ticks :
       {int64_t{0}, int64_t{1}, int64_t{-7}, int64_t{13050311021753041}, int64_t{99999999999999999}})
    EXPECT_EQ(from_mrpt(to_mrpt(Timestamp{ticks})).ticks, ticks);
  // The epoch agrees with MRPT's own conversion.
  EXPECT_DOUBLE_EQ(mrpt::Clock::toDouble(to_mrpt(Timestamp::from_seconds(1305031102.5))), 1305031102.5);
}

TEST(MrptConversions, PoseKeepsItsMeaning) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    Vector6d xi;
    for (int k = 0; k < 6; ++k) xi[k] = random.uniform(-1.5, 1.5);
    const SE3 T = SE3::exp(xi);
    const Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
    mrpt::math::TPoint3D q;
    to_mrpt(T).composePoint(mrpt::math::TPoint3D(p.x(), p.y(), p.z()), q);
    EXPECT_NEAR((Eigen::Vector3d(q.x, q.y, q.z) - T * p).norm(), 0, 1e-13);
    EXPECT_NEAR((from_mrpt(to_mrpt(T)).matrix() - T.matrix()).norm(), 0, 1e-13);
  }
}

TEST(MrptConversions, ForwardMountIsMrptsForwardCamera) {
  const double deg = M_PI / 180;
  const mrpt::poses::CPose3D forward(0, 0, 0, -90 * deg, 0, -90 * deg);
  EXPECT_NEAR((from_mrpt(forward).matrix() - T_vehicle_cam_forward().matrix()).norm(), 0, 1e-15);
}

TEST(MrptConversions, CameraIsExact) {
  const Camera camera{{517.3, 516.4, 318.6, 255.3, 640, 480}, {0.26, -0.95, -0.005, 0.0026, 1.16}};
  const Camera back = from_mrpt(to_mrpt(camera), "here");
  EXPECT_EQ(back.pinhole().fx, 517.3);
  EXPECT_EQ(back.pinhole().fy, 516.4);
  EXPECT_EQ(back.pinhole().cx, 318.6);
  EXPECT_EQ(back.pinhole().cy, 255.3);
  EXPECT_EQ(back.pinhole().width, 640);
  EXPECT_EQ(back.pinhole().height, 480);
  EXPECT_EQ(back.distortion().k1, 0.26);
  EXPECT_EQ(back.distortion().k2, -0.95);
  EXPECT_EQ(back.distortion().p1, -0.005);
  EXPECT_EQ(back.distortion().p2, 0.0026);
  EXPECT_EQ(back.distortion().k3, 1.16);
}

// Largest distance between the pixels of two cameras for the rays of the image of the first.
double largest_difference(const Camera& a, const Camera& b) {
  double most = 0;
  for (double v = 0; v < a.height; v += 20)
    for (double u = 0; u < a.width; u += 20) {
      const auto ray = a.unproject({u, v});
      if (ray && std::atan2(ray->head<2>().norm(), ray->z()) < a.max_angle())
        most = std::max(most, (*b.project(*ray) - Eigen::Vector2d(u, v)).norm());
    }
  return most;
}

TEST(MrptConversions, FisheyeAndRationalLensesAreThose) {
  for (const auto& example : test::camera_examples()) {
    if (!std::holds_alternative<KannalaBrandtModel>(example.camera.model)) continue;
    const Camera back = from_mrpt(to_mrpt(example.camera), "here");
    EXPECT_STREQ(to_string(back.model), "kannala_brandt");
    EXPECT_LT(largest_difference(example.camera, back), 1e-9) << example.name;
  }
  mrpt::img::TCamera camera = to_mrpt(Camera{{500, 500, 320, 240, 640, 480}, {}});
  camera.setDistortionPlumbBob(0.1, 0, 0, 0);
  camera.k4(0.2);
  const Camera rational = from_mrpt(camera, "here");
  ASSERT_STREQ(to_string(rational.model), "rational");
  EXPECT_EQ(std::get<RationalModel>(rational.model).distortion.k4, 0.2);
}

TEST(MrptConversions, ALensThatMrptLacksIsTheClosestFisheyeOrRefused) {
  int refused = 0, converted = 0;
  for (const auto& example : test::camera_examples()) {
    const ClosestMrptCamera closest = closest_mrpt(example.camera);
    if (closest.max_error_px > 0.5) {
      EXPECT_THROW(to_mrpt(example.camera), InputError) << example.name;
      ++refused;
      continue;
    }
    const Camera back = from_mrpt(to_mrpt(example.camera), "here");
    EXPECT_LT(largest_difference(example.camera, back), closest.max_error_px + 0.05) << example.name;
    ++converted;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(converted, 12);
}

TEST(MrptConversions, PixelsAreExact) {
  GrayImage image{5, 3, {}};
  for (int i = 0; i < 15; ++i) image.pixels.push_back(uint8_t(17 * i));
  const GrayImage back = from_mrpt(to_mrpt(image), std::nullopt, "here");
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.pixels, image.pixels);
  EXPECT_THROW(from_mrpt(mrpt::img::CImage(), std::nullopt, "here"), InputError);
}

TEST(MrptConversions, AnImageWithFewerPixelsThanItsSizeIsRefused) {
  EXPECT_THROW(to_mrpt(GrayImage{64, 48, std::vector<uint8_t>(1000)}), InputError);
  EXPECT_THROW(write_png("never.png", {64, 48, std::vector<uint8_t>(1000)}), InputError);
}

}  // namespace
}  // namespace edgevo
