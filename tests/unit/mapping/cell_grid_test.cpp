// SPDX-License-Identifier: BSD-3-Clause
// Cells that points are spread over.
#include "edgevo/mapping/cell_grid.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

// Equidistant: r = f * angle, exactly.
Rectification fisheye() {
  Camera camera(Pinhole{200, 200, 319.5, 239.5, 640, 480});
  camera.model = KannalaBrandtModel{{200, 200, 319.5, 239.5}};
  return Rectification(camera);
}

TEST(CellGrid, APinholeHasSquaresOfWhichTheLastAreCutOff) {
  const CellGrid grid(Pinhole{300, 300, 159.5, 119.5, 320, 235}, 12);
  EXPECT_EQ(grid.columns(), 27);
  EXPECT_EQ(grid.rows(), 20);
  EXPECT_EQ(grid.index(0, 0), 0);
  EXPECT_EQ(grid.index(11.9, 11.9), 0);
  EXPECT_EQ(grid.index(12, 24), 2 * 27 + 1);
  EXPECT_EQ(grid.index(319, 234), grid.size() - 1);
  EXPECT_EQ(grid.centre(28), Eigen::Vector2d(18, 18));
}

TEST(CellGrid, AFisheyeHasAsManyCellsThatAreNarrowInTheMiddleOfItsImage) {
  const Rectification lens = fisheye();
  const Pinhole& target = lens.target();
  const CellGrid grid(lens, 12), squares(target.width, target.height, 12);
  EXPECT_EQ(grid.size(), squares.size());
  const auto columns_in = [&](double x, int px) { return grid.column(x + px) - grid.column(x); };
  // Those of a raw image of 2 * 60 degrees: 200 px a radian, shared among 58 columns.
  EXPECT_NEAR(columns_in(target.cx, 72), 10, 1);
  EXPECT_NEAR(columns_in(target.width - 1 - 72, 72), 2.9, 1);
  for (int x = 1; x < target.width; ++x) ASSERT_GE(grid.column(x), grid.column(x - 1));
  EXPECT_EQ(grid.index(target.width - 1, target.height - 1), grid.size() - 1);
}

TEST(CellGrid, ThePixelsOfACellLieAroundItsMiddle) {
  const Rectification lens = fisheye();
  const CellGrid grid(lens, 12);
  for (int cell = 0; cell < grid.size(); cell += 7) {
    const Eigen::Vector2d middle = grid.centre(cell);
    EXPECT_EQ(grid.index(middle.x(), middle.y()), cell);
  }
}

TEST(CellAxis, RawPositionsThatDoNotAscendGiveEqualIntervals) {
  const CellAxis axis(4, 2, {0, 1, 1, 3, 4});
  EXPECT_EQ(axis.of, (std::vector<int>{0, 0, 1, 1}));
}

TEST(CellAxis, AnIntervalWithinAPixelHasNoPixel) {
  const CellAxis axis(4, 1, {0, 97, 98, 99, 100});
  EXPECT_EQ(axis.of, (std::vector<int>{1, 3, 3, 3}));
  EXPECT_EQ(axis.begin, (std::vector<double>{0, 0, 1, 1, 4}));
}

}  // namespace
}  // namespace edgevo
