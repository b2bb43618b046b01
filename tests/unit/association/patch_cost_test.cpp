// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/patch_cost.h"

#include <gtest/gtest.h>

#include "edgevo/edges/gradient.h"
#include "support/test_images.h"

namespace edgevo {
namespace {

TEST(PatchCost, IgnoresGainAndDistinguishesPositions) {
  const GrayImage image = test::textured_image(120, 90, 4);
  const Gradient gradient = compute_gradient(image.view());
  GrayImage dark = image;
  for (uint8_t& v : dark.pixels) v = uint8_t(0.5 * v);
  const Gradient dark_gradient = compute_gradient(dark.view());
  Patch patch;
  ASSERT_TRUE(sample_patch(gradient.magnitude.view(), 60, 45, 2, &patch));
  ASSERT_TRUE(divide_by_mean(&patch));
  EXPECT_NEAR(patch_cost(patch, gradient.magnitude.view(), 60, 45), 0, 1e-6);
  EXPECT_LT(patch_cost(patch, dark_gradient.magnitude.view(), 60, 45), 0.1);
  EXPECT_GT(patch_cost(patch, gradient.magnitude.view(), 52, 40), 0.15);
  EXPECT_EQ(patch_cost(patch, gradient.magnitude.view(), 1, 45), 2.0);
}

}  // namespace
}  // namespace edgevo
