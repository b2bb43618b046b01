// SPDX-License-Identifier: BSD-3-Clause
#include "straight_line.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

// Vertices on the line p + s d in space, seen by a camera with f = 500.
std::vector<EdgeVertex> on_a_line(double bend) {
  std::vector<EdgeVertex> vertices;
  for (int i = 0; i <= 20; ++i) {
    const double s = 0.1 * i;
    const Eigen::Vector3d p(-1 + s, 0.4 + 0.2 * s + bend * s * (2 - s), 4 + s);
    EdgeVertex v;
    v.px = Eigen::Vector2f(float(500 * p.x() / p.z()), float(500 * p.y() / p.z()));
    v.idepth = float(1 / p.z());
    v.idepth_sigma = 1e-4f;
    vertices.push_back(v);
  }
  return vertices;
}

TEST(StraightLine, ALineInSpaceIsStraight) { EXPECT_TRUE(is_straight(on_a_line(0))); }
TEST(StraightLine, ABentLineIsNotStraight) { EXPECT_FALSE(is_straight(on_a_line(0.05))); }

TEST(StraightLine, ABendTowardsTheCameraShowsInTheDepthAlone) {
  std::vector<EdgeVertex> vertices = on_a_line(0);
  vertices[10].idepth += 0.002f;
  EXPECT_FALSE(is_straight(vertices));
  vertices[10].idepth -= 0.0019f;  // within the standard deviations
  EXPECT_TRUE(is_straight(vertices));
}

TEST(StraightLine, AClosedLineIsNotStraight) {
  std::vector<EdgeVertex> vertices = on_a_line(0);
  vertices.push_back(vertices.front());
  EXPECT_FALSE(is_straight(vertices));
}

}  // namespace
}  // namespace edgevo
