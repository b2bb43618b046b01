// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include "edgevo/core/camera.h"

namespace edgevo::test {

/// Expects images of one size whose pixels show the same directions, to 1e-9.
inline void expect_same_rays(const Camera& found, const Camera& expected) {
  ASSERT_EQ(found.width, expected.width);
  ASSERT_EQ(found.height, expected.height);
  constexpr int kCells = 8;
  int compared = 0;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const Eigen::Vector2d px(i * (found.width - 1.0) / kCells, j * (found.height - 1.0) / kCells);
      const auto a = found.unproject(px), b = expected.unproject(px);
      ASSERT_EQ(a.has_value(), b.has_value()) << px.transpose();
      if (!a) continue;
      ++compared;
      EXPECT_LT((a->normalized() - b->normalized()).norm(), 1e-9) << px.transpose();
    }
  EXPECT_GT(compared, 0);
}

}  // namespace edgevo::test
