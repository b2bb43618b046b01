// SPDX-License-Identifier: BSD-3-Clause
// The mask of the image border that receives no light.
#include "border_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "edgevo/core/random.h"
#include "edgevo/edges/frame_pyramid.h"
#include "support/masked_builder.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

using test::MaskedBuilder;

constexpr int kWidth = 320, kHeight = 240;
constexpr double kRadius = 110;
constexpr int kImages = 20;  // needed to find the mask

bool is_lit(double x, double y) { return std::hypot(x - kWidth / 2.0, y - kHeight / 2.0) < kRadius; }

// A chequered wall that moves to the left, seen through a lens that illuminates only a disc; `black`
// elsewhere.
GrayImage through_lens(double shift, double black, double noise = 0, uint64_t seed = 1) {
  GrayImage image = test::make_image(kWidth, kHeight, [&](double x, double y) {
    const bool bright = (int(std::floor((x + shift) / 24)) + int(std::floor(y / 24))) % 2 == 0;
    return is_lit(x, y) ? (bright ? 180.0 : 70.0) : black;
  });
  Random random(seed);
  for (uint8_t& p : image.pixels) p = uint8_t(std::clamp(p + noise * random.normal(), 0.0, 255.0));
  return image;
}

double masked_share(const Plane<uint8_t>& mask) {
  return double(std::count(mask.row(0), mask.row(0) + kWidth * kHeight, 255)) / (kWidth * kHeight);
}

double share_of_disc_outside() { return 1 - M_PI * kRadius * kRadius / (kWidth * kHeight); }

TEST(BorderMask, CoversTheAreaOutsideTheImageCircle) {
  for (const double noise : {0.0, 8.0}) {
    BorderMask border;
    for (int k = 0; k < kImages; ++k) border.add(through_lens(k, 4, noise, uint64_t(k)).view());
    ASSERT_TRUE(border.mask()) << "noise " << noise;
    const Plane<uint8_t>& mask = *border.mask();
    EXPECT_NEAR(masked_share(mask), share_of_disc_outside(), 0.09);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double from_edge = std::hypot(x - kWidth / 2.0, y - kHeight / 2.0) - kRadius;
        if (from_edge > -3) {
          ASSERT_EQ(mask.at(x, y), 255) << x << ' ' << y << " noise " << noise;
        }
        if (from_edge < -10) {
          ASSERT_EQ(mask.at(x, y), 0) << x << ' ' << y << " noise " << noise;
        }
      }
  }
}

TEST(BorderMask, ExcludesShadowsOfTheScene) {
  const auto shadow_at = [](double x0) {
    return test::make_image(kWidth, kHeight,
                            [&](double x, double) { return x > x0 && x < x0 + 60 ? 2.0 : 120.0; });
  };
  BorderMask border;
  for (int k = 0; k < kImages; ++k) {
    EXPECT_FALSE(border.mask()) << "too early at image " << k;
    border.add(shadow_at(0).view());
  }
  EXPECT_TRUE(border.mask()) << "the camera does not move";
  border.add(shadow_at(70).view());
  EXPECT_FALSE(border.mask());
  for (int k = 0; k < kImages; ++k) border.add(shadow_at(0).view());
  EXPECT_FALSE(border.mask()) << "the area was lit";
}

TEST(BorderMask, ExcludesSmallGrayAndEnclosedAreas) {
  const auto expect_none = [](const std::function<double(double, double)>& gray) {
    BorderMask border;
    for (int k = 0; k < kImages; ++k) border.add(test::make_image(kWidth, kHeight, gray).view());
    EXPECT_FALSE(border.mask());
  };
  expect_none([](double x, double) { return x < 0.03 * kWidth ? 0.0 : 120.0; });
  expect_none([](double x, double) { return x < 100 ? 60.0 : 120.0; });
  expect_none([](double x, double y) { return std::hypot(x - 160, y - 120) < 80 ? 0.0 : 120.0; });
}

TEST(BorderMask, RecoversFromBlackFirstImages) {
  BorderMask border;
  for (int k = 0; k < kImages; ++k)
    border.add(test::make_image(kWidth, kHeight, [](double, double) { return 0.0; }).view());
  border.add(test::textured_image(kWidth, kHeight, 3).view());
  EXPECT_FALSE(border.mask());
}

// Edges that lie on the outline of the disc.
int edges_of_outline(const FramePyramid& pyramid) {
  int count = 0;
  for (int l = 0; l < 2; ++l)
    for (const EdgePixel& e : pyramid.levels[size_t(l)].edges.pixels) {
      const double s = 1 << l;
      count += std::abs(std::hypot(s * e.x - kWidth / 2.0, s * e.y - kHeight / 2.0) - kRadius) < 4;
    }
  return count;
}

TEST(BorderMask, SuppressesEdges) {
  Camera camera;
  camera.set_pinhole({250, 250, kWidth / 2.0, kHeight / 2.0, kWidth, kHeight});
  const EdgeParams params;
  EXPECT_GT(edges_of_outline(*PyramidBuilder(camera, params).build(through_lens(0, 30))), 400)
      << "gray belongs to the scene";
  MaskedBuilder builder(camera, params);
  PyramidBuilder rebuilder(camera, params);
  for (int k = 1; k < kImages; ++k) builder.build(through_lens(k, 0));
  const auto pyramid = builder.build(through_lens(kImages, 0));
  EXPECT_EQ(edges_of_outline(*pyramid), 0);
  EXPECT_GT(pyramid->finest().edges.pixels.size(), 1000u);
  rebuilder.set_correction({0.001, 0});
  EXPECT_EQ(edges_of_outline(*rebuilder.rebuild(*pyramid)), 0)
      << "the outline of the image that it was made of";
}

Camera lens_camera() {
  Camera camera;
  camera.set_pinhole({250, 250, kWidth / 2.0, kHeight / 2.0, kWidth, kHeight});
  return camera;
}

// Rolling-shutter rectification moves the border mask with the rows.
TEST(BorderMask, MovesWithTheRowsOfARollingShutter) {
  constexpr double kReadoutS = 0.03;
  ImageMotion motion;
  motion.velocity << 5, 0, 0, 0, 0, 0;  // 19 pixels at the first row and the last
  motion.idepth.setConstant(1);
  MaskedBuilder builder(lens_camera(), EdgeParams());
  builder.builder.set_correction({0, kReadoutS});
  for (int k = 0; k < kImages; ++k) builder.build(through_lens(k, 0), motion);
  const auto pyramid = builder.build(through_lens(kImages, 0), motion);
  ASSERT_TRUE(pyramid->border_mask);
  const Pinhole p = lens_camera().pinhole();
  int on_outline = 0, shifted = 0;
  for (const EdgePixel& e : pyramid->finest().edges.pixels) {
    const Eigen::Vector2d px = e.position().cast<double>();
    const Eigen::Vector2d x = add_rolling(p, kReadoutS, motion, p.ray(px).head<2>());
    const Eigen::Vector2d taken(p.fx * x.x() + p.cx, p.fy * x.y() + p.cy);
    on_outline += std::abs((taken - Eigen::Vector2d(p.cx, p.cy)).norm() - kRadius) < 4;
    shifted += (taken - px).norm() > 8;
  }
  EXPECT_EQ(on_outline, 0);
  EXPECT_GT(shifted, 200);
}

}  // namespace
}  // namespace edgevo
