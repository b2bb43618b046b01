// SPDX-License-Identifier: BSD-3-Clause
// Search range of new points.
#include "edgevo/mapping/idepth_prior.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(IdepthPrior, SearchesAroundTheDepthsNearbyAndElsewhereAroundTheMedian) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const DepthFilterParams params;
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, 0.5);
  prior.add({50, 50}, 0.2);
  prior.add({60, 45}, 0.3);
  prior.add({200, 200}, 0.1);
  const IdepthRange near = prior.range({55, 55}), elsewhere = prior.range({300, 20});
  EXPECT_DOUBLE_EQ(near.low, 0.4 * 0.2);
  EXPECT_DOUBLE_EQ(near.high, 2.5 * 0.3);
  EXPECT_DOUBLE_EQ(elsewhere.likely, 0.2);
  EXPECT_LT(elsewhere.low, 0.1 * near.low);
  EXPECT_GT(elsewhere.high, 2 * near.high);
}

TEST(IdepthPrior, WithoutNeighboursItSearchesAroundTheMedianEverywhere) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  DepthFilterParams params;
  params.use_neighbour_depths = false;
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, 0.5);
  for (const double idepth : {0.2, 0.3, 0.1}) prior.add({50, 50}, idepth);
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).low, 0.02 * 0.2);
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).high, 8 * 0.2);
}

TEST(IdepthPrior, WithoutKnownDepthsTheEarlierMedianIsUsed) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const DepthFilterParams params;
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, 0.5);
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).likely, 0.5);
}

// A rotation on the spot once drove all points to infinity, and the unit of the map with them.
TEST(IdepthPrior, PointsAtInfinitySayNothingOfTheDepthsAroundThem) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const DepthFilterParams params;
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, 0.5);
  for (int x = 10; x < 300; x += 20) prior.add({double(x), 55}, 1e-6);
  EXPECT_DOUBLE_EQ(prior.median(), 0.5);
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).likely, 0.5);
  EXPECT_TRUE(prior.occupied(prior.grid().index(50, 55))) << "no other point is needed there";
}

}  // namespace
}  // namespace edgevo
