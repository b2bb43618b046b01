// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/patch_template.h"

#include <gtest/gtest.h>

#include "support/test_images.h"

namespace edgevo {
namespace {

// Centre of the patch with the strongest contrast, where rounding to gray levels is negligible.
Eigen::Vector2f contrasting_place(const GrayImage& image) {
  Eigen::Vector2f best(10, 10);
  int most = -1;
  for (int y = 10; y < image.height - 10; ++y)
    for (int x = 10; x < image.width - 10; ++x) {
      const auto at = [&](int u, int v) { return int(image.pixels[size_t(v) * image.width + u]); };
      const int contrast = std::abs(at(x - 2, y) - at(x + 2, y)) + std::abs(at(x, y - 2) - at(x, y + 2));
      if (contrast > most) most = contrast, best = {float(x), float(y)};
    }
  return best;
}

// The patch gradient is the derivative of the difference by a shift of the patch. Template and image are the
// same here, so that they have the same slope.
TEST(PatchTemplate, GradientMatchesANumericShift) {
  const GrayImage image = test::textured_image(80, 60, 21);
  const Eigen::Vector2f at = contrasting_place(image);
  const PatchTemplates patches = cut_patches(image.view(), {at});
  ASSERT_TRUE(patches[0].usable);
  for (const Eigen::Vector2f& shift :
       {Eigen::Vector2f(0.2f, 0.0f), Eigen::Vector2f(0.0f, -0.2f), Eigen::Vector2f(0.15f, 0.1f)}) {
    const auto cost = [&](double dx, double dy) {
      const Eigen::Vector2f p = at + shift + Eigen::Vector2f(float(dx), float(dy));
      return 0.5 * compare_patch(image.view(), patches[0], p.x(), p.y()).mean_square;
    };
    const PatchDifference d = compare_patch(image.view(), patches[0], at.x() + shift.x(), at.y() + shift.y());
    const Eigen::Vector2d numeric((cost(0.05, 0) - cost(-0.05, 0)) / 0.1,
                                  (cost(0, 0.05) - cost(0, -0.05)) / 0.1);
    EXPECT_LT((d.gradient - numeric).norm(), 0.3 * numeric.norm() + 3e-3);
  }
}

TEST(PatchTemplate, GainAndOffsetCancel) {
  GrayImage image = test::textured_image(80, 60, 21);
  const Eigen::Vector2f at = contrasting_place(image);
  const PatchTemplates patches = cut_patches(image.view(), {at});
  for (uint8_t& v : image.pixels) v = uint8_t(0.5 * v + 20);
  EXPECT_LT(compare_patch(image.view(), patches[0], at.x(), at.y()).mean_square, 1e-3);
}

TEST(PatchTemplate, OutsideAndFlatPatchesAreUnusable) {
  const GrayImage flat{40, 30, std::vector<uint8_t>(1200, 99)};
  const GrayImage image = test::textured_image(40, 30, 21);
  EXPECT_FALSE(cut_patches(flat.view(), {{20.0f, 15.0f}})[0].usable);
  EXPECT_FALSE(cut_patches(image.view(), {{1.0f, 15.0f}})[0].usable);
  const PatchTemplates patches = cut_patches(image.view(), {{20.0f, 15.0f}});
  EXPECT_FALSE(compare_patch(image.view(), patches[0], 38.5f, 15.0f).usable);
  EXPECT_FALSE(compare_patch(image.view(), patches[0], std::nanf(""), 15.0f).usable);
}

}  // namespace
}  // namespace edgevo
