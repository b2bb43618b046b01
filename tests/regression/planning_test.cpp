// Stock planners find their way with the map files of a run, and what they find is free in the true scene:
// OMPL with FCL in 3D through edges.bt, MRPT's PlannerSimple2D in the plane over grid.gridmap.gz.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/nav/planners/PlannerSimple2D.h>
#include <mrpt/serialization/CArchive.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "edgevo/mrpt_bridge/gridmap_writer.h"
#include "edgevo/occupancy/grid_map.h"
#include "edgevo/occupancy/octree_map.h"
#include "street_drive.h"
#include "support/temp_folder.h"
#include "true_scene.h"

namespace edgevo::testing {
namespace {

constexpr double kRobotRadius = 0.5;  // planned with
constexpr double kTrueRadius = 0.3;   // a voxel less: that must touch nothing in the true scene
constexpr int kStart = 15, kGoal = 85;

class Planning : public StreetDrive {
 protected:
  static Eigen::Vector3d camera(int frame) {
    return (T_map_world(*metric_run_) * *metric_run_->frames[size_t(frame)].T_world_cam).translation();
  }
  // One camera height under the nearest camera: over 70 m the map's axes, those of the first camera, are a
  // hand's breadth off the level.
  static double ground_at(const Eigen::Vector2d& p, double camera_height) {
    Eigen::Vector3d nearest = camera(kStart);
    for (int frame = kStart; frame <= kGoal; ++frame)
      if ((camera(frame).head<2>() - p).norm() < (nearest.head<2>() - p).norm()) nearest = camera(frame);
    return nearest.z() - camera_height;
  }
  // Of the whole way, looked at every five centimetres, from the nearest true surface.
  static double least_distance(const std::vector<Eigen::Vector3d>& way) {
    double least = 10;
    for (size_t i = 1; i < way.size(); ++i) {
      const int steps = 1 + int((way[i] - way[i - 1]).norm() / 0.05);
      for (int s = 0; s <= steps; ++s) {
        const Eigen::Vector3d p = way[i - 1] + (way[i] - way[i - 1]) * s / steps;
        least = std::min(least, truth_->distance(p, least));
      }
    }
    return least;
  }
};

// A ball may be where nothing occupied touches it, and where its middle was seen to be free: unknown is no
// way.
class BallInOctree {
 public:
  explicit BallInOctree(const std::string& bt)
      : tree_(std::make_shared<octomap::OcTree>(bt)),
        geometry_(std::make_shared<fcl::OcTreed>(tree_)),
        map_(geometry_),
        ball_(std::make_shared<fcl::Sphered>(kRobotRadius)) {}

  bool is_free(const Eigen::Vector3d& p) const {
    const auto* node = tree_->search(p.x(), p.y(), p.z());
    if (!node || tree_->isNodeOccupied(node)) return false;
    fcl::CollisionObjectd ball(ball_, Eigen::Matrix3d::Identity(), p);
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(&ball, &map_, request, result) == 0;
  }

 private:
  std::shared_ptr<octomap::OcTree> tree_;
  std::shared_ptr<fcl::OcTreed> geometry_;
  fcl::CollisionObjectd map_;
  std::shared_ptr<fcl::Sphered> ball_;
};

// The free place nearest to `p`: the camera passed there, but a voxel right at it may not have been crossed
// by a ray.
std::optional<Eigen::Vector3d> free_place_near(const BallInOctree& map, const Eigen::Vector3d& p) {
  for (double radius = 0; radius < 2; radius += 0.1)
    for (int i = 0; i < 16; ++i) {
      const Eigen::Vector3d q =
          p + radius * Eigen::Vector3d(std::cos(i * M_PI / 8), std::sin(i * M_PI / 8), 0);
      if (map.is_free(q)) return q;
    }
  return std::nullopt;
}

std::vector<Eigen::Vector3d> plan_3d(const BallInOctree& map, const Eigen::Vector3d& start,
                                     const Eigen::Vector3d& goal) {
  namespace ob = ompl::base;
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  const auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  for (int i = 0; i < 3; ++i) {
    bounds.setLow(unsigned(i), std::min(start[i], goal[i]) - (i < 2 ? 10 : 1));
    bounds.setHigh(unsigned(i), std::max(start[i], goal[i]) + (i < 2 ? 10 : 1));
  }
  space->setBounds(bounds);
  ompl::geometric::SimpleSetup setup(space);
  const auto position = [](const ob::State* s) {
    const auto* v = s->as<ob::RealVectorStateSpace::StateType>();
    return Eigen::Vector3d(v->values[0], v->values[1], v->values[2]);
  };
  setup.setStateValidityChecker([&](const ob::State* s) { return map.is_free(position(s)); });
  setup.getSpaceInformation()->setStateValidityCheckingResolution(0.1 / space->getMaximumExtent());
  ob::ScopedState<> from(space), to(space);
  for (unsigned i = 0; i < 3; ++i) from[i] = start[i], to[i] = goal[i];
  setup.setStartAndGoalStates(from, to);
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
  std::vector<Eigen::Vector3d> path;
  if (setup.solve(60.0) != ob::PlannerStatus::EXACT_SOLUTION) return path;
  setup.getSolutionPath().interpolate();
  for (const ob::State* s : setup.getSolutionPath().getStates()) path.push_back(position(s));
  return path;
}

TEST_F(Planning, OmplAndFclThroughTheOctree) {
  const test::TempFolder folder;
  map_->write_bt(folder / "edges.bt");
  const BallInOctree map(folder / "edges.bt");
  const auto start = free_place_near(map, camera(kStart)), goal = free_place_near(map, camera(kGoal));
  ASSERT_TRUE(start && goal) << "no free place where the camera was";
  // A wall without texture has no edge in the map, and a sampled way may touch it: of one map's ways two or
  // three of nine do, of which seeds depends on every voxel. Hence five ways, and most of them must keep
  // clear.
  ompl::RNG::setSeed(1);
  constexpr int kWays = 5;
  int clear = 0;
  for (int way = 0; way < kWays; ++way) {
    const std::vector<Eigen::Vector3d> path = plan_3d(map, *start, *goal);
    ASSERT_FALSE(path.empty()) << "no way found";
    const double least = least_distance(path);
    std::cout << "[ figures  ] a way of " << path.size() << " states over " << (*goal - *start).norm()
              << " m, at least " << least << " m from every true surface" << std::endl;
    clear += least > kTrueRadius;
  }
  EXPECT_GT(2 * clear, kWays);
}

// Every cell within the robot's radius was seen to be free.
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
  planner.occupancyThreshold = 0.6f;  // unknown (0.5) is no way
  std::deque<mrpt::math::TPoint2D> path;
  bool not_found = true;
  // Right before the first cameras some cells were crossed by no ray: the robot starts where it knows what is
  // around it.
  int from = kStart;
  while (from < kGoal / 2 && !is_free_around(grid, camera(from))) ++from;
  const Eigen::Vector3d start = camera(from), goal = camera(kGoal);
  planner.computePath(grid, {start.x(), start.y(), 0}, {goal.x(), goal.y(), 0}, path, not_found);
  ASSERT_FALSE(not_found) << "from frame " << from;
  ASSERT_GT(path.size(), 10u);
  // The robot is a post whose lower end stands clear of the road by more than its radius.
  double least = 10;
  for (const double over_ground : {0.6, 1.0, 1.5}) {
    std::vector<Eigen::Vector3d> way;
    for (const auto& p : path) way.emplace_back(p.x, p.y, ground_at({p.x, p.y}, height) + over_ground);
    least = std::min(least, least_distance(way));
  }
  std::cout << "[ figures  ] a way of " << path.size() << " points, at least " << least
            << " m from every true surface" << std::endl;
  EXPECT_GT(least, kTrueRadius);
}

}  // namespace
}  // namespace edgevo::testing
