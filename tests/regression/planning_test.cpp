// SPDX-License-Identifier: BSD-3-Clause
// Stock planners find paths on the map files of a run, and these paths are free in the true scene:
// OMPL with FCL in 3D through edges.bt, MRPT's PlannerSimple2D in the plane over grid.gridmap.gz.
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/nav/planners/PlannerSimple2D.h>
#include <mrpt/serialization/CArchive.h>
#include <algorithm>
#include <deque>

#include "edgevo/mrpt_bridge/gridmap_writer.h"
#include "edgevo/occupancy/grid_map.h"
#include "edgevo/occupancy/octree_map.h"
#include "octree_planner.h"
#include "street_run.h"
#include "support/temp_folder.h"
#include "true_scene.h"

namespace edgevo::test {
namespace {

constexpr double kRobotRadius = 0.5;  // used for planning
// A voxel less: a ball of this radius must touch nothing in the true scene.
constexpr double kTrueRadius = 0.3;
constexpr int kStart = 15, kGoal = 85;

class Planning : public StreetRun {
 protected:
  static Eigen::Vector3d camera(int frame) {
    return (T_map_world(*metric_run_) * *metric_run_->frames[size_t(frame)].T_world_cam).translation();
  }
  // One camera height under the nearest camera: over 70 m the axes of the map, those of the first camera, are
  // about 10 cm off level.
  static double ground_at(const Eigen::Vector2d& p, double camera_height) {
    Eigen::Vector3d nearest = camera(kStart);
    for (int frame = kStart; frame <= kGoal; ++frame)
      if ((camera(frame).head<2>() - p).norm() < (nearest.head<2>() - p).norm()) nearest = camera(frame);
    return nearest.z() - camera_height;
  }
};

TEST_F(Planning, OmplAndFclThroughTheOctree) {
  const test::TempFolder folder;
  map_->write_bt(folder / "edges.bt");
  const BallInOctree map(folder / "edges.bt", kRobotRadius);
  const auto start = map.free_position_near(camera(kStart), 2),
             goal = map.free_position_near(camera(kGoal), 2);
  ASSERT_TRUE(start && goal) << "no free position where the camera was";
  seed_planner(1);
  for (int attempt = 0; attempt < 5; ++attempt) {
    const std::vector<Eigen::Vector3d> path = plan_3d(map, *start, *goal);
    ASSERT_FALSE(path.empty()) << "no path found";
    const double least = truth_->nearest(path).distance;
    std::cout << "[ figures  ] a path of " << path.size() << " states over " << (*goal - *start).norm()
              << " m, at least " << least << " m from every true surface" << std::endl;
    EXPECT_GT(least, kTrueRadius);
  }
}

// Whether every cell within the robot's radius was observed to be free.
bool is_free_around(const mrpt::maps::COccupancyGridMap2D& grid, const Eigen::Vector3d& p) {
  const int reach = int(std::ceil(kRobotRadius / grid.getResolution()));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (grid.getCell(grid.x2idx(p.x()) + dx, grid.y2idx(p.y()) + dy) < 0.6f) return false;
  return true;
}

TEST_F(Planning, MrptSimplePlannerOverTheGrid) {
  const test::TempFolder folder;
  GridParams grid_params;
  const double height = 1.65;
  write_gridmap(make_grid(*metric_run_, *map_, height, grid_params), folder / "grid.gridmap.gz");
  mrpt::io::CFileGZInputStream file(folder / "grid.gridmap.gz");
  mrpt::maps::COccupancyGridMap2D grid;
  mrpt::serialization::archiveFrom(file) >> grid;
  mrpt::nav::PlannerSimple2D planner;
  planner.robotRadius = float(kRobotRadius);
  planner.occupancyThreshold = 0.6f;  // unknown (0.5) is blocked
  std::deque<mrpt::math::TPoint2D> path;
  bool not_found = true;
  // No ray crossed some of the cells right in front of the first cameras: the robot starts where its
  // surroundings are known.
  int from = kStart;
  while (from < kGoal / 2 && !is_free_around(grid, camera(from))) ++from;
  const Eigen::Vector3d start = camera(from), goal = camera(kGoal);
  planner.computePath(grid, {start.x(), start.y(), 0}, {goal.x(), goal.y(), 0}, path, not_found);
  ASSERT_FALSE(not_found) << "from frame " << from;
  ASSERT_GT(path.size(), 10u);
  // The robot is a post whose lower end clears the road by more than its radius.
  double least = 10;
  for (const double over_ground : {0.6, 1.0, 1.5}) {
    std::vector<Eigen::Vector3d> post;
    for (const auto& p : path) post.emplace_back(p.x, p.y, ground_at({p.x, p.y}, height) + over_ground);
    least = std::min(least, truth_->nearest(post).distance);
  }
  std::cout << "[ figures  ] a path of " << path.size() << " points, at least " << least
            << " m from every true surface" << std::endl;
  EXPECT_GT(least, kTrueRadius);
}

}  // namespace
}  // namespace edgevo::test
