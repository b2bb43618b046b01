// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/zoom_change.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(ZoomChange, IsThatOverTenFrames) {
  ZoomChange change;
  EXPECT_TRUE(std::isnan(change.add({0, 0.003, 1}).depths)) << "one frame says nothing";
  for (int i = 1; i < 30; ++i) {
    const FeignedMotion found = change.add({0.002 * i, 0.003, 0.9});
    const int frames = std::min(i, kMotionTolerance.frames);
    EXPECT_NEAR(found.zoom, 0.002 * frames, 1e-9);
    EXPECT_NEAR(found.depths, 0.9 * 0.002 * frames, 1e-9);
    EXPECT_NEAR(found.sigma, 0.9 * 0.003 * std::sqrt(2), 1e-9);
  }
  change.interrupt();
  EXPECT_TRUE(std::isnan(change.add({0.1, 0.003, 1}).depths));
}

TEST(ZoomChange, OfAFrameThatDoesNotKnowItIsUnknown) {
  ZoomChange change;
  change.add({0, 0.003, 1});
  EXPECT_TRUE(std::isnan(change.add({}).depths));
}

}  // namespace
}  // namespace edgevo
