// SPDX-License-Identifier: BSD-3-Clause
// Images of more than 8 bits: their depth lasts through undistortion, pyramid, gradient and edges.
#include "deep_image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/edges/deep_gray.h"
#include "edgevo/edges/frame_pyramid.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

constexpr int kDeepWidth = 240, kDeepHeight = 180;
constexpr IntensityScale kTwelveBits{0, 16};

double scene_at(double x, double y) {
  static const test::Texture texture(5);
  return texture.at({x, y});
}

// The scene in `gain` times its light, in 12 bits unless another scale is given.
GrayImage seen(double gain, double offset = 0, const IntensityScale& scale = kTwelveBits) {
  return test::make_deep_image(kDeepWidth, kDeepHeight, scale,
                               [=](double x, double y) { return offset + gain * scene_at(x, y); });
}

std::shared_ptr<const FramePyramid> pyramid_of(const GrayImage& image, const Distortion& distortion = {}) {
  Camera camera = Pinhole{200, 200, 119.5, 89.5, kDeepWidth, kDeepHeight};
  camera.set_distortion(distortion);
  return PyramidBuilder(camera, EdgeParams()).build(image);
}

// Share of the edge pixels of `a` that have one of `b` within `distance` pixels.
double shared(const FramePyramid& a, const FramePyramid& b, double distance) {
  const PyramidLevel& other = b.finest();
  int found = 0;
  for (const EdgePixel& e : a.finest().edges.pixels) {
    const int pixel = other.field.nearest_pixel(e.x, e.y);
    if (pixel < 0) continue;
    const EdgePixel& near = other.edges.pixels[size_t(other.field.edge_at(pixel))];
    found += std::abs(e.normal().dot(near.position() - e.position())) < distance;
  }
  return double(found) / double(a.finest().edges.pixels.size());
}

TEST(DeepImage, GivesTheEdgesOfTheSameSceneInEightBits) {
  for (const Distortion& distortion : {Distortion{}, Distortion{-0.2, 0.03, 0, 0, 0}}) {
    const auto eight = pyramid_of(
        test::make_image(kDeepWidth, kDeepHeight, [](double x, double y) { return scene_at(x, y); }),
        distortion);
    ASSERT_GT(eight->finest().edges.pixels.size(), 1000u);
    EXPECT_TRUE(eight->finest().deep.empty());
    for (const IntensityScale& scale :
         {IntensityScale{0, 4}, kTwelveBits, IntensityScale{0, 256}, IntensityScale{28745, 10}}) {
      const auto deep = pyramid_of(seen(1, 0, scale), distortion);
      EXPECT_FALSE(deep->finest().deep.empty());
      EXPECT_GT(shared(*eight, *deep, 0.1), 0.98) << scale.per_level;
      EXPECT_GT(shared(*deep, *eight, 0.1), 0.98) << scale.per_level;
    }
  }
}

TEST(DeepImage, KeepsItsGrayLevelsWhereItUsesTheScale) {
  const GrayImage image = seen(0.9, 10);
  const Exposure e = exposure_of(image);
  EXPECT_EQ(e.gain, 1);
  EXPECT_EQ(e.shift, 0);
  const Plane<uint16_t> gray = deep_gray(image, e);
  const Plane<uint8_t> pixels = shown(gray);
  for (int y = 0; y < kDeepHeight; ++y)
    for (int x = 0; x < kDeepWidth; ++x) {
      ASSERT_EQ(gray.at(x, y), kDeepSteps * (image.values[size_t(y) * kDeepWidth + x] / 16.0 - kDeepBlack));
      ASSERT_EQ(pixels.at(x, y), std::lround(image.values[size_t(y) * kDeepWidth + x] / 16.0));
    }
}

// 40 of 4096 levels, and a haze far from black.
TEST(DeepImage, OfADimOrDullSceneHasItsEdges) {
  const auto bright = pyramid_of(seen(1));
  for (const auto& [gain, offset] : {std::pair(0.01, 0.0), {0.02, 180.0}}) {
    const auto dim = pyramid_of(seen(gain, offset));
    EXPECT_GT(shared(*bright, *dim, 0.3), 0.9) << gain;
    EXPECT_GT(shared(*dim, *bright, 0.3), 0.9) << gain;
  }
}

// A scene eight times as bright as the images that decided the scale.
TEST(DeepImage, BeyondTheScaleKeepsItsEdges) {
  const auto usual = pyramid_of(seen(1)), bright = pyramid_of(seen(8));
  EXPECT_GT(shared(*usual, *bright, 0.1), 0.98);
  EXPECT_GT(shared(*bright, *usual, 0.1), 0.98);
}

TEST(DeepImage, NoiseOfAnEvenWallGivesNoEdges) {
  for (const double sigma : {0.05, 0.5, 2.0}) {
    Random random(3);
    const auto wall = pyramid_of(test::make_deep_image(
        kDeepWidth, kDeepHeight, kTwelveBits, [&](double, double) { return 100 + sigma * random.normal(); }));
    EXPECT_LT(wall->finest().edges.pixels.size(), 50u) << sigma;
  }
  EXPECT_TRUE(pyramid_of(seen(0))->finest().edges.pixels.empty());
}

}  // namespace
}  // namespace edgevo
