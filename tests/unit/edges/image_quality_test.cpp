// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/image_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "support/test_images.h"

namespace edgevo {
namespace {

constexpr int kQualityWidth = 320, kQualityHeight = 240;

Camera camera() { return Pinhole{260, 260, 159.5, 119.5, kQualityWidth, kQualityHeight}; }

std::shared_ptr<const FramePyramid> pyramid(const GrayImage& image, const EdgeParams& params = {}) {
  return PyramidBuilder(camera(), params).build(image);
}

// Two slanted steps with a Gaussian profile of standard deviation `sigma`.
GrayImage steps(double sigma) {
  return test::make_image(kQualityWidth, kQualityHeight, [&](double x, double y) {
    const double first = 0.8 * (x - 100) + 0.6 * (y - 120), second = 0.9 * (x - 220) - 0.436 * (y - 120);
    return 60 + 50 * std::erf(first / (sigma * std::sqrt(2))) +
           60 * std::erf(second / (sigma * std::sqrt(2)));
  });
}

GrayImage textured() {
  const test::Texture texture(5);
  return test::make_image(kQualityWidth, kQualityHeight, [&](double x, double y) {
    return 70 + 0.4 * texture.at({x, y});
  });
}

GrayImage blurred(GrayImage image, double sigma) {
  cv::Mat pixels(image.height, image.width, CV_8U, image.pixels.data());
  cv::GaussianBlur(pixels, pixels, {}, sigma);
  return image;
}

TEST(Blur, OfAStepFollowsFromTheSmoothingOfTheTwoLevels) {
  for (const double sigma : {0.3, 1.0, 1.5, 2.0, 3.0, 5.0}) {
    const double square = sigma * sigma;
    EXPECT_NEAR(edge_blur(*pyramid(steps(sigma))), std::sqrt((square + 1.4) / (square + 6.6)), 0.05) << sigma;
  }
}

TEST(Blur, RisesWhenTheImageIsBlurred) {
  double before = edge_blur(*pyramid(textured()));
  for (const double sigma : {1.0, 2.0, 4.0}) {
    const double now = edge_blur(*pyramid(blurred(textured(), sigma)));
    EXPECT_GT(now, before) << sigma;
    before = now;
  }
}

TEST(Blur, DoesNotDependOnTheExposure) {
  GrayImage dark = steps(1.5);
  for (uint8_t& gray : dark.pixels) gray = uint8_t(gray / 3 + 20);
  EXPECT_NEAR(edge_blur(*pyramid(dark)), edge_blur(*pyramid(steps(1.5))), 0.1);
}

TEST(Blur, IsUnknownWithoutEdgesOnTwoLevels) {
  EXPECT_TRUE(std::isnan(edge_blur(
      *pyramid(test::make_image(kQualityWidth, kQualityHeight, [](double, double) { return 128; })))));
  EdgeParams one_level;
  one_level.edge_levels = 1;
  EXPECT_TRUE(std::isnan(edge_blur(*pyramid(steps(1), one_level))));
}

TEST(SaturatedShare, IsThatOfThePixelsAtTheEndsOfTheRange) {
  const auto columns = [](int dark, int bright) {
    return test::make_image(kQualityWidth, kQualityHeight, [=](double x, double) {
      return x < dark ? 1 : x >= kQualityWidth - bright ? 254 : 128 + 100 * std::sin(x);
    });
  };
  EXPECT_EQ(saturated_share(*pyramid(columns(0, 0))), 0);
  EXPECT_DOUBLE_EQ(saturated_share(*pyramid(columns(32, 0))), 0.1);
  EXPECT_DOUBLE_EQ(saturated_share(*pyramid(columns(0, 64))), 0.2);
  EXPECT_DOUBLE_EQ(saturated_share(*pyramid(columns(32, 64))), 0.3);
}

TEST(SaturatedShare, EndsTwoGrayLevelsFromTheEnds) {
  const auto flat = [](int gray) {
    return saturated_share(
        *pyramid(test::make_image(kQualityWidth, kQualityHeight, [=](double, double) { return gray; })));
  };
  EXPECT_EQ(flat(0), 1);
  EXPECT_EQ(flat(2), 1);
  EXPECT_EQ(flat(3), 0);
  EXPECT_EQ(flat(252), 0);
  EXPECT_EQ(flat(253), 1);
  EXPECT_EQ(flat(255), 1);
}

// A dim image of 12 bits is not black, and one beyond the white of its scale not saturated.
TEST(SaturatedShare, OfMoreThanEightBitsIsAtTheEndsOfTheCamera) {
  const auto share_at = [](double gray) {
    return saturated_share(*pyramid(
        test::make_deep_image(kQualityWidth, kQualityHeight, {0, 16}, [=](double, double) { return gray; })));
  };
  EXPECT_EQ(share_at(0), 1);
  EXPECT_EQ(share_at(1), 0);
  EXPECT_EQ(share_at(255), 0);
  EXPECT_EQ(share_at(4095 / 16.), 1);
  EXPECT_EQ(share_at(400), 0);
}

TEST(SaturatedShare, RisesWithOverexposure) {
  GrayImage bright = textured();
  for (uint8_t& gray : bright.pixels) gray = uint8_t(std::min(255, 2 * gray + 40));
  EXPECT_EQ(saturated_share(*pyramid(textured())), 0);
  EXPECT_GT(saturated_share(*pyramid(bright)), 0.2);
}

TEST(SaturatedShare, TheMaskedBorderDoesNotCount) {
  auto masked = std::make_shared<FramePyramid>();
  masked->source =
      test::make_image(kQualityWidth, kQualityHeight, [](double x, double) { return x < 80 ? 0 : 128; });
  EXPECT_DOUBLE_EQ(saturated_share(*masked), 0.25);
  auto mask = std::make_shared<Plane<uint8_t>>(kQualityWidth, kQualityHeight);
  for (int y = 0; y < kQualityHeight; ++y)
    for (int x = 0; x < kQualityWidth; ++x) mask->at(x, y) = x < 80 ? 255 : 0;
  masked->border_mask = mask;
  EXPECT_EQ(saturated_share(*masked), 0);
}

}  // namespace
}  // namespace edgevo
