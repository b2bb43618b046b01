// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/simplemap_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "playback_test_run.h"

namespace edgevo {
namespace {

class SimplemapWriter : public test::FolderTest {
 protected:
  mrpt::maps::CSimpleMap written(const edgevo::Run& run) const {
    write_simplemap(run, PointFilter(), path("keyframes.simplemap"));
    mrpt::maps::CSimpleMap map;
    EXPECT_TRUE(map.loadFromFile(path("keyframes.simplemap")));
    return map;
  }
};

TEST_F(SimplemapWriter, PointsLandInPlaceInMrptsMaps) {
  const edgevo::Run run = test::small_run();
  const auto map = written(run);
  ASSERT_EQ(map.size(), 3u);
  mrpt::maps::CSimplePointsMap points;
  points.insertionOptions.minDistBetweenLaserPoints = 0;
  points.loadFromSimpleMap(map);
  mrpt::maps::COctoMap octomap(0.1);
  octomap.loadFromSimpleMap(map);
  const auto world = test::world_points();
  ASSERT_EQ(points.size(), 3 * world.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d expected = T_zup_world() * world[i % world.size()];
    float x, y, z;
    points.getPoint(i, x, y, z);
    EXPECT_LT((Eigen::Vector3d(x, y, z) - expected).norm(), 1e-3);
    double occupancy = 0;
    ASSERT_TRUE(octomap.getPointOccupancy(x, y, z, occupancy));
    EXPECT_GT(occupancy, 0.5);
    // Near the middle of the ray from the first camera: free, so the rays start at the camera.
    ASSERT_TRUE(octomap.getPointOccupancy(0.47f * x, 0.47f * y, 0.47f * z, occupancy));
    EXPECT_LT(occupancy, 0.5);
  }
}

TEST_F(SimplemapWriter, PosesAreTheCamerasZUp) {
  const edgevo::Run run = test::small_run();
  const auto map = written(run);
  const auto [pose, observations] = map.get(2);
  mrpt::poses::CPose3D mean;
  pose->getMean(mean);
  EXPECT_LT((from_mrpt(mean).inverse() * T_zup_world() * run.keyframes[2].T_world_cam).log().norm(), 1e-9);
  EXPECT_EQ(observations->size(), 1u);
}

TEST_F(SimplemapWriter, KeyframesWithoutGoodPointsAreSkipped) {
  edgevo::Run run = test::small_run();
  for (EdgePoint& p : run.keyframes[1].points) p.observations = 0;
  EXPECT_EQ(written(run).size(), 2u);
}

TEST_F(SimplemapWriter, EmptyRunGivesAnEmptyMap) { EXPECT_EQ(written(edgevo::Run()).size(), 0u); }

TEST_F(SimplemapWriter, FullDiskIsReported) {
  EXPECT_THROW(write_simplemap(test::small_run(), PointFilter(), "/dev/full"), InputError);
}

}  // namespace
}  // namespace edgevo
