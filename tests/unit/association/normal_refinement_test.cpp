// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/normal_refinement.h"

#include <gtest/gtest.h>

#include "support/plane_scene.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

TEST(NormalRefinement, FindsASubPixelShiftAlongTheNormal) {
  const test::Texture texture(17);
  for (double shift : {-1.3, -0.4, 0.0, 0.27, 0.9}) {
    const Eigen::Vector2d normal = Eigen::Vector2d(0.8, 0.6);
    const GrayImage host = test::make_image(100, 80, [&](double x, double y) { return texture.at({x, y}); });
    const GrayImage target = test::make_image(100, 80, [&](double x, double y) {
      return 0.7 * texture.at(Eigen::Vector2d(x, y) - shift * normal) + 15;
    });
    NormalTemplate patch;
    ASSERT_TRUE(make_normal_template(host.view(), {50, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
    const NormalRefinement r = refine_along_normal(patch, target.view(), {50, 40}, normal);
    ASSERT_TRUE(r.accepted) << shift;
    EXPECT_NEAR(r.move_px, shift, 0.04);
    EXPECT_LT(r.zncc_loss, 0.02);
  }
}

TEST(NormalRefinement, RejectsUnrelatedPositionsAndFlatPatches) {
  const GrayImage host = test::textured_image(100, 80, 17), other = test::textured_image(100, 80, 18);
  const GrayImage flat{100, 80, std::vector<uint8_t>(8000, 77)};
  const Eigen::Vector2d normal(1, 0);
  NormalTemplate patch;
  EXPECT_FALSE(make_normal_template(flat.view(), {50, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  EXPECT_FALSE(make_normal_template(host.view(), {2, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  ASSERT_TRUE(make_normal_template(host.view(), {50, 40}, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  EXPECT_FALSE(refine_along_normal(patch, other.view(), {50, 40}, normal).accepted);
  EXPECT_FALSE(refine_along_normal(patch, flat.view(), {50, 40}, normal).accepted);
}

// The slope of the template is the derivative of the warped patch along the normal.
TEST(NormalRefinement, SlopeIsTheDerivativeOfTheDifference) {
  const GrayImage image = test::textured_image(100, 80, 17);
  const Eigen::Vector2d normal(0.8, 0.6), at(50, 40);
  NormalTemplate patch;
  ASSERT_TRUE(make_normal_template(image.view(), at, Eigen::Matrix2d::Identity(), normal, 4, &patch));
  const auto difference =
      [&](double move) {  // half the squared difference to the image moved along the normal
        Patch current;
        EXPECT_TRUE(
            sample_patch(image.view(), at.x() + move * normal.x(), at.y() + move * normal.y(), 4, &current));
        EXPECT_GT(normalise(&current, 1.0f), 0);
        double sum = 0;
        for (int i = 0; i < current.size(); ++i)
          sum += 0.5 * std::pow(current.value[i] - patch.value.value[i], 2);
        return sum;
      };
  // At small moves the difference is slope_square move^2 / 2: its second derivative is slope_square.
  constexpr double kStep = 0.25;
  const double numeric = (difference(kStep) - 2 * difference(0) + difference(-kStep)) / (kStep * kStep);
  EXPECT_NEAR(numeric / patch.slope_square, 1.0, 0.35)
      << "bilinear sampling between pixels blurs, which adds to the difference";
}

}  // namespace
}  // namespace edgevo
