// SPDX-License-Identifier: BSD-3-Clause
// Search range of new points.
#include "edgevo/mapping/idepth_prior.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(IdepthPrior, SearchesAroundTheDepthsNearbyAndElsewhereAroundTheMedian) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const DepthFilterParams params;
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, {0.5, 0});
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
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, {0.5, 0});
  for (const double idepth : {0.2, 0.3, 0.1}) prior.add({50, 50}, idepth);
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).low, 0.02 * 0.2);
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).high, 8 * 0.2);
}

TEST(IdepthPrior, WithoutKnownDepthsTheEarlierMedianIsUsed) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const DepthFilterParams params;
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, {0.5, 0});
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).likely, 0.5);
}

// A rotation on the spot once drove all points to infinity, and the unit of the map with them.
TEST(IdepthPrior, PointsAtInfinitySayNothingOfTheDepthsAroundThem) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const DepthFilterParams params;
  IdepthPrior prior(CellGrid(camera, params.cell_px), params, {0.5, 0});
  for (int x = 10; x < 300; x += 20) prior.add({double(x), 55}, 1e-6);
  EXPECT_DOUBLE_EQ(prior.median(), 0.5);
  EXPECT_DOUBLE_EQ(prior.range({55, 55}).likely, 0.5);
  EXPECT_TRUE(prior.occupied(prior.grid().index(50, 55))) << "no other point is needed there";
}

// On the way back from open land: what lies ahead is far, what comes into view as near as it was before.
TEST(IdepthPrior, SearchesAsNearAsTheMapHasSeen) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const DepthFilterParams params;
  IdepthPrior houses(CellGrid(camera, params.cell_px), params, {0.5, 0});
  for (int x = 10; x < 300; x += 10) houses.add({double(x), 55}, x == 10 ? 50 : 0.2);  // one is wrong
  EXPECT_DOUBLE_EQ(houses.seen().nearest, 0.2);
  IdepthPrior land(CellGrid(camera, params.cell_px), params, houses.seen());
  for (int x = 10; x < 300; x += 20) land.add({double(x), 55}, 0.01);
  EXPECT_DOUBLE_EQ(land.range({200, 200}).high, 0.2);
  EXPECT_DOUBLE_EQ(land.range({200, 200}).likely, 0.01);
  EXPECT_DOUBLE_EQ(land.seen().nearest, 0.2);
}

}  // namespace
}  // namespace edgevo
