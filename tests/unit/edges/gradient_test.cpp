// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/gradient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/edges/canny.h"
#include "edgevo/edges/deep_gray.h"
#include "edgevo/edges/edge_detector.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

GrayImage noise(int width, int height, uint64_t seed) {
  Random random(seed);
  GrayImage image{width, height, std::vector<uint8_t>(size_t(width) * height)};
  for (uint8_t& v : image.pixels) v = uint8_t(random.below(256));
  return image;
}

// The definition: a binomial of 5x5 pixels, then Sobel, in double, pixel by pixel.
template <class T>
Eigen::Vector2d gradient_by_definition(const ImageView<T>& image, int x, int y) {
  const double binomial[5] = {1 / 16., 4 / 16., 6 / 16., 4 / 16., 1 / 16.};
  const auto pixel = [&](int u, int v) {
    return double(image.at(std::clamp(u, 0, image.width - 1), std::clamp(v, 0, image.height - 1)));
  };
  const auto smooth = [&](int u, int v) {
    double sum = 0;
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i) sum += binomial[i + 2] * binomial[j + 2] * pixel(u + i, v + j);
    return sum;
  };
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  for (int k = -1; k <= 1; ++k) {
    const double share = k == 0 ? 2 : 1;
    g.x() += share * (smooth(x + 1, y + k) - smooth(x - 1, y + k));
    g.y() += share * (smooth(x + k, y + 1) - smooth(x + k, y - 1));
  }
  return g;
}

class GradientSizes : public ::testing::TestWithParam<std::pair<int, int>> {};

TEST_P(GradientSizes, EqualsItsDefinitionUpToTheBorder) {
  const auto [width, height] = GetParam();
  for (const GrayImage& image : {noise(width, height, 5), test::textured_image(width, height, 3)}) {
    const Gradient g = compute_gradient(image.view());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Eigen::Vector2d expected = gradient_by_definition(image.view(), x, y);
        // The rounding of the smoothed rows to an eighth, through the taps 1 4 5 on both sides.
        ASSERT_NEAR(g.dx.at(x, y) / kGradientSteps, expected.x(), 0.33) << x << " " << y;
        ASSERT_NEAR(g.dy.at(x, y) / kGradientSteps, expected.y(), 0.33) << x << " " << y;
        ASSERT_NEAR(g.magnitude.at(x, y), std::hypot(g.dx.at(x, y), g.dy.at(x, y)) / kGradientSteps, 1e-3)
            << x << " " << y;
      }
  }
}

TEST_P(GradientSizes, OfSixteenBitsEqualsItsDefinitionToRounding) {
  const auto [width, height] = GetParam();
  Random random(7);
  Plane<uint16_t> image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = uint16_t(20000 + random.below(40000));
  const Gradient g = compute_gradient(image.view());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector2d expected =
          kGradientSteps * gradient_by_definition(image.view(), x, y) / kDeepSteps;
      ASSERT_NEAR(g.dx.at(x, y), expected.x(), 0.501) << x << " " << y;
      ASSERT_NEAR(g.dy.at(x, y), expected.y(), 0.501) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, GradientSizes,
                         ::testing::Values(std::pair{64, 48}, std::pair{101, 37}, std::pair{7, 5},
                                           std::pair{1, 9}, std::pair{9, 1}, std::pair{1, 1},
                                           std::pair{3, 3}));

TEST(Gradient, AnExtremeStepDoesNotOverflow) {
  for (const bool upright : {true, false}) {
    const GrayImage step =
        test::make_image(40, 40, [&](double x, double y) { return (upright ? x : y) < 20 ? 0.0 : 255.0; });
    const Gradient g = compute_gradient(step.view());
    const Eigen::Vector2d expected = gradient_by_definition(step.view(), 20, 20);
    EXPECT_NEAR(g.dx.at(20, 20) / kGradientSteps, expected.x(), 0.33);
    EXPECT_NEAR(g.dy.at(20, 20) / kGradientSteps, expected.y(), 0.33);
  }
}

TEST(Gradient, AnExtremeStepOfSixteenBitsIsLimited) {
  Plane<uint16_t> step(40, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) step.at(x, y) = x < 20 ? 65535 : 0;
  const Gradient g = compute_gradient(step.view());
  EXPECT_EQ(g.dx.at(20, 20), -32767);
  EXPECT_EQ(g.dy.at(20, 20), 0);
}

TEST(GradientHistogram, PercentilesMatchTheSortedMagnitudes) {
  const Plane<float> magnitude = compute_gradient(noise(120, 90, 9).view()).magnitude;
  std::vector<float> sorted;
  for (int y = 0; y < 90; y += 2)
    for (int x = 0; x < 120; x += 2) sorted.push_back(magnitude.at(x, y));
  std::sort(sorted.begin(), sorted.end());
  const GradientHistogram histogram(magnitude);
  for (double share : {0.5, 0.9, 1.0}) {
    const float expected = sorted[size_t(std::ceil(share * double(sorted.size()))) - 1];
    EXPECT_GE(histogram.percentile(share), expected);
    EXPECT_LT(histogram.percentile(share), expected + 1.001f);
  }
}

// ---- Canny by its definition ----

// Maxima across the edge, by the angle of the gradient; then flood from the strong ones.
std::vector<uint8_t> canny_by_definition(const Gradient& g, double low, double high) {
  const int width = g.magnitude.width(), height = g.magnitude.height();
  std::vector<uint8_t> mask(size_t(width) * height, 0);
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x) {
      const float m = g.magnitude.at(x, y);
      double degrees = std::atan2(double(g.dy.at(x, y)), double(g.dx.at(x, y))) * 180 / M_PI;
      if (degrees < 0) degrees += 180;
      int sx = 1, sy = 0;
      if (degrees > 22.5 && degrees < 67.5) sy = 1;
      if (degrees >= 67.5 && degrees <= 112.5) sx = 0, sy = 1;
      if (degrees > 112.5 && degrees < 157.5) sx = -1, sy = 1;
      if (m > low && m > g.magnitude.at(x - sx, y - sy) && m >= g.magnitude.at(x + sx, y + sy))
        mask[size_t(y) * width + x] = m > high ? 2 : 1;
    }
  for (bool grown = true; grown;) {
    grown = false;
    for (int y = 1; y + 1 < height; ++y)
      for (int x = 1; x + 1 < width; ++x) {
        if (mask[size_t(y) * width + x] != 1) continue;
        for (int k = 0; k < 9; ++k)
          if (mask[size_t(y + k / 3 - 1) * width + x + k % 3 - 1] == 2)
            mask[size_t(y) * width + x] = 2, grown = true;
      }
  }
  for (uint8_t& v : mask) v = v == 2;
  return mask;
}

TEST(CannyDetector, EqualsItsDefinition) {
  EdgeParams params;
  const GrayImage image = test::textured_image(160, 120, 21);
  const Gradient g = compute_gradient(image.view());
  const Plane<uint8_t> mask = make_edge_detector(params)->detect({image.view(), g});
  const GradientHistogram histogram(g.magnitude);
  const double high = std::max(
      {double(std::min(histogram.percentile(params.canny_percentile), 0.7f * histogram.percentile(1.0))),
       params.min_gradient * kSobelPerGrayLevel});
  const std::vector<uint8_t> expected = canny_by_definition(g, params.canny_low_ratio * high, high);
  int edges = 0, different = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      edges += expected[size_t(y) * 160 + x];
      different += (mask.at(x, y) != 0) != (expected[size_t(y) * 160 + x] != 0);
    }
  EXPECT_GT(edges, 500);
  EXPECT_LE(different, edges / 200)
      << "gradients within rounding of 22.5 degrees, thresholds within rounding";
}

TEST(Canny, OfAnImageOfAnyWidthEqualsItsDefinition) {
  constexpr int kHeight = 60;
  for (int width = 3; width <= 20; ++width) {
    const Gradient g = compute_gradient(test::textured_image(width, kHeight, uint64_t(width)).view());
    const Plane<uint8_t> mask = canny(g, 20, 60);
    const std::vector<uint8_t> expected = canny_by_definition(g, 20, 60);
    int different = 0;
    for (int i = 0; i < width * kHeight; ++i)
      different += (mask.row(0)[i] != 0) != (expected[size_t(i)] != 0);
    EXPECT_LE(different, 2) << width << " columns; gradients within rounding of 22.5 degrees";
  }
}

TEST(Plane, MemoryIsReused) {
  const float* first = nullptr;
  {
    Plane<float> plane(301, 203);
    first = plane.row(0);
  }
  const Plane<float> next(301, 203), other(301, 203);
  EXPECT_EQ(next.row(0), first);
  EXPECT_NE(other.row(0), first);
}

}  // namespace
}  // namespace edgevo
