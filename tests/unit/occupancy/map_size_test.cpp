// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/map_size.h"

#include <gmock/gmock.h>

#include "edgevo/core/error.h"
#include "edgevo/occupancy/octree_map.h"
#include "pole_and_wall.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

OccupancyParams params_at(const std::string& resolution) {
  OccupancyParams params;
  params.resolution = resolution;
  return params;
}

std::string complaint(const Run& run, const std::string& resolution, double free_bytes) {
  try {
    check_map_size(run, params_at(resolution), free_bytes, "run");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(MapSize, IsOfTheRightMagnitude) {
  const edgevo::Run run = test::pole_and_wall(2, 2).run;
  for (const char* resolution : {"0.4", "0.2", "0.1"}) {
    const OctreeStats made = OctreeMap(run, params_at(resolution)).stats();
    const double voxels = double(made.occupied_voxels + made.free_voxels);
    const MapSize size = estimate_map_size(run, params_at(resolution));
    EXPECT_GT(size.voxels, 0.8 * voxels) << resolution;
    EXPECT_LT(size.voxels, 3 * voxels) << resolution;
  }
}

TEST(MapSize, AMapTooLargeIsRefusedWithAResolutionThatFits) {
  const edgevo::Run run = test::pole_and_wall(3, 3).run;
  EXPECT_EQ(complaint(run, "0.1", 1e9), "");
  const std::string message = complaint(run, "0.002", 1e9);
  EXPECT_THAT(message, HasSubstr("run: voxels of 0.0020 would take about"));
  EXPECT_THAT(message, HasSubstr("1.0 GB are free; give a resolution of"));
  const size_t at = message.find("resolution of ") + 14;
  const std::string least = message.substr(at, message.find(' ', at) - at);
  EXPECT_EQ(complaint(run, least, 1e9), "") << least;
}

TEST(MapSize, AMapThatCoversOnlyTheOriginIsRefused) {
  const edgevo::Run run = test::pole_and_wall(3, 3).run;
  EXPECT_THAT(complaint(run, "0.0001", 1e18), HasSubstr("reach only 3.3 from the origin"));
}

TEST(MapSize, AVoxelLargerThanTheRunIsRefused) {
  const edgevo::Run run = test::pole_and_wall(3, 3).run;
  EXPECT_THAT(complaint(run, "1000", 1e9), HasSubstr("run: one voxel of that size would hold the whole run"));
  EXPECT_EQ(complaint(run, "auto", 1e9), "");
}

// A run that ended with exit code 2 for what it found: the resolution was the default.
TEST(MapSize, VoxelsOfNoGivenSizeAreCoarsenedUntilTheyHoldTheRun) {
  const edgevo::Run run = test::pole_and_wall(3, 3).run;
  OccupancyParams params = params_at("auto");
  EXPECT_EQ(coarsen_to_fit(run, 1e9, &params), "");
  EXPECT_EQ(params.resolution, "auto");
  params.resolution_share = 1e-6;
  EXPECT_THAT(coarsen_to_fit(run, 1e9, &params), HasSubstr("which cannot hold the run"));
  EXPECT_GT(params.given_resolution(), 0);
  EXPECT_NO_THROW(check_map_size(run, params, 1e9, "run"));
}

TEST(MapSize, AGivenSizeIsNotChanged) {
  OccupancyParams params = params_at("0.0001");
  EXPECT_EQ(coarsen_to_fit(test::pole_and_wall(3, 3).run, 1e9, &params), "");
  EXPECT_EQ(params.resolution, "0.0001");
}

TEST(MapSize, AnEmptyRunIsSmall) {
  EXPECT_EQ(estimate_map_size(edgevo::Run(), params_at("0.0001")).voxels, 0);
  EXPECT_EQ(complaint(edgevo::Run(), "0.0001", 1), "");
  EXPECT_GT(free_memory(), 0);
}

}  // namespace
}  // namespace edgevo
