// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/grid_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "pole_and_wall.h"
#include "support/temp_folder.h"
#include "support/text.h"

namespace edgevo {
namespace {

using test::content;
using ::testing::HasSubstr;

struct MadeGrid {
  test::PoleAndWall scene = test::pole_and_wall(1, 5);
  OccupancyParams params;
  OccupancyGrid grid;

  explicit MadeGrid(double camera_height = 1.0, GridParams grid_params = {}) {
    params.resolution = "0.1";
    params.max_range = "15";
    grid = make_grid(scene.run, OctreeMap(scene.run, params), camera_height, grid_params);
  }
  /// Cell of a world point (camera axes: x right, z forward).
  GridCell at(double x, double z) const {
    const Eigen::Vector3d p = T_map_world(scene.run) * Eigen::Vector3d(x, 0, z);
    return grid.at(int(std::floor((p.x() - grid.origin_x) / grid.resolution)),
                   int(std::floor((p.y() - grid.origin_y) / grid.resolution)));
  }
};

TEST(GridMap, OccupiedFreeAndUnknownAreDistinguished) {
  const MadeGrid made;
  EXPECT_EQ(made.at(0.05, 10.05), GridCell::kOccupied) << "the wall";
  EXPECT_EQ(made.at(0.05, 5.05), GridCell::kOccupied) << "the pole";
  EXPECT_EQ(made.at(0.45, 5.05), GridCell::kFree) << "next to the pole";
  EXPECT_EQ(made.at(3.9, 3.05), GridCell::kUnknown) << "outside the view";
}

// The pole reaches from 1 above the camera to 1 below it; the band of heights decides whether it is an
// obstacle.
TEST(GridMap, OnlyTheBandOfHeightsCounts) {
  GridParams over_the_pole;
  over_the_pole.band_low = 2.3,
  over_the_pole.band_high = 3;  // camera heights over the ground, which lies one under the camera
  EXPECT_NE(MadeGrid(1.0, over_the_pole).at(0.05, 5.05), GridCell::kOccupied);
  EXPECT_EQ(MadeGrid(1.0, over_the_pole).at(0.05, 10.05), GridCell::kOccupied) << "the wall is two high";
  const MadeGrid unknown_ground(0, over_the_pole);
  EXPECT_EQ(unknown_ground.at(0.05, 5.05), GridCell::kOccupied) << "without ground all heights count";
  EXPECT_THAT(unknown_ground.grid.statement, HasSubstr("ground is not known"));
}

TEST(GridMap, FollowsTheGroundUphill) {
  auto scene = test::pole_and_wall(2, 5);
  edgevo::Run run = scene.run;
  KeyframeRecord high = run.keyframes[0];  // the same scene again, 20 ahead and 5 higher
  high.T_world_cam = SE3(Eigen::Quaterniond::Identity(), {0, -5, 20});
  run.keyframes.push_back(high);
  OccupancyParams params;
  params.resolution = "0.1", params.max_range = "15";
  GridParams over_the_pole;
  over_the_pole.band_low = 2.3, over_the_pole.band_high = 3;
  const OccupancyGrid grid = make_grid(run, OctreeMap(run, params), 1.0, over_the_pole);
  const Eigen::Vector3d p = T_map_world(run) * Eigen::Vector3d(0.05, 0, 25.05);
  EXPECT_NE(grid.at(int((p.x() - grid.origin_x) / 0.1), int((p.y() - grid.origin_y) / 0.1)),
            GridCell::kOccupied);
}

// The map has an obstacle, the pole, within the corridor that the vehicle has driven.
TEST(GridMap, TheDrivenCorridorIsFree) {
  test::PoleAndWall scene = test::pole_and_wall(1, 5);
  for (int i = 0; i < 9; ++i) {
    FrameRecord frame;
    frame.index = i;
    frame.T_world_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0, double(i)});
    scene.run.frames.push_back(frame);
  }
  OccupancyParams params;
  params.resolution = "0.1", params.max_range = "15";
  const OctreeMap map(scene.run, params);
  const auto at = [&](const OccupancyGrid& grid, double x, double z) {
    const Eigen::Vector3d p = T_map_world(scene.run) * Eigen::Vector3d(x, 0, z);
    return grid.at(int(std::floor((p.x() - grid.origin_x) / grid.resolution)),
                   int(std::floor((p.y() - grid.origin_y) / grid.resolution)));
  };
  GridParams as_the_map_says;
  as_the_map_says.driven_width = 0;
  EXPECT_EQ(at(make_grid(scene.run, map, 1.0, as_the_map_says), 0.05, 5.05), GridCell::kOccupied);
  const OccupancyGrid grid = make_grid(scene.run, map, 1.0, GridParams());
  for (const double x : {-0.5, 0.0, 0.05, 0.5}) EXPECT_EQ(at(grid, x, 5.05), GridCell::kFree) << x;
  EXPECT_EQ(at(grid, 0.05, 10.05), GridCell::kOccupied) << "the wall, where nobody has been";
  EXPECT_EQ(at(make_grid(scene.run, map, 0, GridParams()), 0.05, 5.05), GridCell::kOccupied)
      << "height of the ground unknown";
}

TEST(GridMap, RosFilesHoldTheTrinaryConvention) {
  const MadeGrid made;
  const test::TempFolder folder;
  write_ros_grid(made.grid, folder / "grid.yaml");
  const std::string yaml = content(folder / "grid.yaml"), image = content(folder / "grid.pgm");
  for (const char* line : {"image: grid.pgm\n", "mode: trinary\n", "resolution: 0.1", "negate: 0\n",
                           "occupied_thresh: 0.65\n", "free_thresh: 0.196\n"})
    EXPECT_THAT(yaml, HasSubstr(line));
  const size_t pixels = size_t(made.grid.width) * size_t(made.grid.height);
  ASSERT_GT(image.size(), pixels);
  const std::string rows = image.substr(image.size() - pixels);
  EXPECT_EQ(size_t(std::count(rows.begin(), rows.end(), char(0))),
            size_t(std::count(made.grid.cells.begin(), made.grid.cells.end(), GridCell::kOccupied)));
  EXPECT_EQ(size_t(std::count(rows.begin(), rows.end(), char(205))),
            size_t(std::count(made.grid.cells.begin(), made.grid.cells.end(), GridCell::kUnknown)));
  // The first row of the image is the one of largest y.
  for (int x = 0; x < made.grid.width; ++x)
    EXPECT_EQ(uint8_t(rows[size_t(x)]) == 0, made.grid.at(x, made.grid.height - 1) == GridCell::kOccupied);
}

TEST(GridMap, EmptyMapIsOneUnknownCell) {
  const OccupancyGrid grid =
      make_grid(edgevo::Run(), OctreeMap(edgevo::Run(), OccupancyParams()), 0, GridParams());
  EXPECT_EQ(grid.cells, std::vector<GridCell>{GridCell::kUnknown});
}

TEST(GridParams, RefusesInvalidValues) {
  GridParams params;
  params.band_high = params.band_low;
  EXPECT_THROW(params.check(), InputError);
  params = {};
  params.camera_height = "-1";
  EXPECT_THROW(params.check(), InputError);
}

}  // namespace
}  // namespace edgevo
