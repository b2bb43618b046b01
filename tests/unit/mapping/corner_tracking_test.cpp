// SPDX-License-Identifier: BSD-3-Clause
// How far the corners of a first view have moved when some of them are lost.
#include "corner_tracking.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

// `count` corners of which number i moves by i pixels to the right.
Corners corners_moved(int count, bool after) {
  Corners corners;
  for (int i = 0; i < count; ++i) corners.emplace_back(float(after ? 100 + i : 100), float(10 * i));
  return corners;
}

double motion_of(int left, int all) {
  return median_motion(size_t(all), corners_moved(left, false), corners_moved(left, true));
}

TEST(MedianCornerMotion, OfAllCornersIsTheirMedian) { EXPECT_EQ(motion_of(41, 41), 20); }

// The fastest half is lost one after the other: the median of all does not fall with them.
TEST(MedianCornerMotion, LostCornersCountAsMovedFurther) {
  for (int left = 41; left > 28; --left) EXPECT_EQ(motion_of(left, 41), 20) << left << " of 41 left";
}

// Lost corners do not show how far they moved: at least a quarter of the remaining ones lies above the
// median.
TEST(MedianCornerMotion, ManyLostCornersDoNotDecideAlone) {
  EXPECT_EQ(motion_of(20, 41), 15);
  EXPECT_EQ(motion_of(4, 4000), 3);
}

}  // namespace
}  // namespace edgevo
