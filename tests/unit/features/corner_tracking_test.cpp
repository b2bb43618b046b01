// SPDX-License-Identifier: BSD-3-Clause
// Which corners are measured in both directions, and how far those of a first view have moved when some of
// them are lost.
#include "edgevo/features/corner_tracking.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "edgevo/core/random.h"

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

// A wall of tiles: a joint from left to right, one from top to bottom that meets it at (60, 60), and noise.
cv::Mat joints() {
  cv::Mat image(120, 200, CV_8U, cv::Scalar(180));
  cv::line(image, {0, 60}, {199, 60}, cv::Scalar(60), 3);
  cv::line(image, {60, 0}, {60, 119}, cv::Scalar(60), 3);
  cv::GaussianBlur(image, image, {5, 5}, 1);
  Random random(7);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) image.at<uchar>(v, u) += uchar(random.below(5));
  return image;
}

// Along a joint a corner stays where the search begins, so that any motion along it seems to be confirmed.
TEST(DropOnEdges, KeepsWhereEdgesMeetAndDropsWhatLiesOnOne) {
  const Corners crossing{{60, 60}, {64, 57}};
  const Corners along{{150, 60}, {150, 58}, {60, 20}, {120, 61}};
  Corners corners = along;
  corners.insert(corners.end(), crossing.begin(), crossing.end());
  drop_on_edges(joints(), 1, &corners);
  EXPECT_EQ(corners, crossing);
}

TEST(DropOnEdges, DropsWhatHasNoGradientAndTakesThoseAtTheBorder) {
  Corners corners{{3, 3}, {196, 116}};
  drop_on_edges(cv::Mat(120, 200, CV_8U, cv::Scalar(90)), 1, &corners);
  EXPECT_TRUE(corners.empty());
}

TEST(DropOnEdges, KeepsAllWhereAnySigmaIsAllowed) {
  Corners corners{{150, 60}, {60, 20}, {60, 60}};
  drop_on_edges(joints(), 1000, &corners);
  EXPECT_EQ(corners.size(), 3u);
}

}  // namespace
}  // namespace edgevo
