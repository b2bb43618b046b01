// SPDX-License-Identifier: BSD-3-Clause
#include "point_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace edgevo {
namespace {

TEST(PointCells, CountsLikeBruteForce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-3, 3), radii(0, 0.5);
  const auto point = [&] { return Eigen::Vector3d(place(random), place(random), 0.1 * place(random)); };
  PointCells cells(0.5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 300; ++i) cells.add(points.emplace_back(point()));
  int found = 0, not_found = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = point();
    const double radius = radii(random);
    const auto near =
        std::count_if(points.begin(), points.end(), [&](const auto& q) { return (q - p).norm() <= radius; });
    for (int count = 1; count <= 4; ++count) {
      EXPECT_EQ(cells.has_within(p, radius, count), near >= count) << i;
      ++(near >= count ? found : not_found);
    }
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(not_found, 500);
}

TEST(PointCells, APointAtThePositionItselfCounts) {
  PointCells cells(1);
  EXPECT_FALSE(cells.has_within({0, 0, 0}, 1, 1));
  cells.add({0, 0, 0});
  EXPECT_TRUE(cells.has_within({0, 0, 0}, 0, 1));
  EXPECT_FALSE(cells.has_within({0, 0, 0}, 1, 2));
}

}  // namespace
}  // namespace edgevo
