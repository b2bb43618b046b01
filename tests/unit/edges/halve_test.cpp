// SPDX-License-Identifier: BSD-3-Clause
#include "halve.h"

#include <gtest/gtest.h>

#include <cstring>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/random.h"
#include "edgevo/edges/opencv_view.h"

namespace edgevo {
namespace {

TEST(Halve, HasTheBytesOfOpenCvForEvenAndOddSizes) {
  Random random(2);
  for (const auto& [from_width, from_height] : {std::pair{2, 2}, {3, 3}, {4, 6}, {5, 9}, {64, 33}, {137, 70}})
    for (const int up : {0, 1}) {
      Plane<uint8_t> from(from_width, from_height);
      for (int i = 0; i < from_width * from_height; ++i) from.row(0)[i] = uint8_t(random.below(256));
      const int width = (from_width + up) / 2, height = (from_height + up) / 2;
      Plane<uint8_t> expected(width, height);
      cv::Mat half = as_mat(expected);
      cv::pyrDown(as_mat(from), half, half.size());
      const Plane<uint8_t> found = halve(from, width, height);
      EXPECT_EQ(std::memcmp(found.row(0), expected.row(0), size_t(width * height)), 0)
          << from_width << "x" << from_height;
    }
}

}  // namespace
}  // namespace edgevo
