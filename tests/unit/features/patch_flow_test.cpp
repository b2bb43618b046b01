// SPDX-License-Identifier: BSD-3-Clause
#include "patch_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "corner_strength.h"

namespace edgevo {
namespace {

constexpr int kWavesWidth = 320, kWavesHeight = 240;

// Soft waves in both directions, seen shifted.
std::shared_ptr<const FramePyramid> waves(double shift_x, double shift_y, double gain = 1, double dark = 0) {
  static PyramidBuilder builder(Rectification({300, 300, 159.5, 119.5, kWavesWidth, kWavesHeight}),
                                EdgeParams());
  GrayImage image{kWavesWidth, kWavesHeight, {}};
  for (int y = 0; y < kWavesHeight; ++y)
    for (int x = 0; x < kWavesWidth; ++x) {
      const double u = x - shift_x, v = y - shift_y;
      const double gray = 120 + 50 * std::sin(0.21 * u + 0.05 * v) + 50 * std::sin(0.19 * v - 0.07 * u);
      image.pixels.push_back(uint8_t(std::lround(gain * gray - dark)));
    }
  return builder.build(image);
}

TEST(PatchFlow, UsesTheImagesOfTheFrame) {
  const auto frame = waves(0, 0);
  const FlowImage image(frame, 1);
  ASSERT_EQ(image.levels().size(), 4u);
  for (size_t i = 0; i + 1 < frame->levels.size(); ++i)
    EXPECT_EQ(image.levels()[i].data, frame->levels[i + 1].gray.row(0));
  EXPECT_EQ(image.levels().back().width, (frame->levels.back().gray.width() + 1) / 2);
}

TEST(PatchFlow, FindsAShiftToAFewHundredthsOfAPixelAlsoAtTheBorderAndInOtherLight) {
  const FlowImage before(waves(0, 0), 0), now(waves(5.3, -3.6, 0.7, 10), 0);
  for (const Eigen::Vector2f& from :
       {Eigen::Vector2f(100.4f, 90.7f), Eigen::Vector2f(5.f, 120.f), Eigen::Vector2f(200.f, 233.f)}) {
    const std::optional<Eigen::Vector2f> found = follow_patch(before, now, from, from);
    ASSERT_TRUE(found) << from.transpose();
    EXPECT_LT((*found - from - Eigen::Vector2f(5.3f, -3.6f)).norm(), 0.05f) << from.transpose();
  }
}

TEST(PatchFlow, FindsNothingOutsideTheImageOrWithoutACorner) {
  const FlowImage before(waves(0, 0), 0), now(waves(0, 0), 0), black(waves(0, 0, 0), 0);
  const Eigen::Vector2f from(100, 90);
  EXPECT_FALSE(follow_patch(before, now, from, Eigen::Vector2f(-1e6f, 1e9f)));
  EXPECT_FALSE(follow_patch(before, now, from, Eigen::Vector2f(NAN, 0)));
  EXPECT_FALSE(follow_patch(black, now, from, from));
}

TEST(CornerStrength, IsThatOfOpenCvButAtTheBorder) {
  const auto frame = waves(0.3, 0.8);
  const ImageView<uint8_t> image = frame->finest().gray.view();
  const Plane<float> strength = corner_strength(image);
  cv::Mat expected;
  cv::cornerMinEigenVal(cv::Mat(kWavesHeight, kWavesWidth, CV_8U, const_cast<uint8_t*>(image.data)), expected,
                        3);
  double most = 0;
  cv::minMaxLoc(expected, nullptr, &most);
  const float scale = strength.at(50, 60) / expected.at<float>(60, 50);
  for (int y = 2; y < kWavesHeight - 2; ++y)
    for (int x = 2; x < kWavesWidth - 2; ++x)
      ASSERT_NEAR(strength.at(x, y) / scale, expected.at<float>(y, x), 1e-3 * most) << x << " " << y;
  EXPECT_EQ(strength.at(1, 100), 0);
  EXPECT_EQ(strength.at(100, 1), 0);
}

}  // namespace
}  // namespace edgevo
