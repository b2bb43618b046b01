// Stock planners find their way with the map files of a run, and what they find is free in the true scene: OMPL with FCL in 3D through edges.bt,
// MRPT's PlannerSimple2D in the plane over grid.gridmap.gz.
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

constexpr double kTrueRadius = 0.25;   // of a robot that must touch nothing in the true scene
constexpr double kRobotRadius = 0.5;   // planned with: a voxel more, and what sparse edges leave out
constexpr int kStart = 15, kGoal = 85;

class Planning : public StreetDrive {
 protected:
  Planning() : run_metres_(in_metres("robot_pose", track(0))), truth_(*renderer_, run_metres_) {
    params_.resolution = "0.2";
    params_.max_range = "20";
  }
  Eigen::Vector3d camera(int frame) const {
    return (T_map_world(run_metres_) * *run_metres_.frames[size_t(frame)].T_world_cam).translation();
  }

  edgevo::Run run_metres_;
  TrueScene truth_;
  OccupancyParams params_;
};

// A ball may be where nothing occupied touches it, and where its middle was seen to be free: unknown is no way.
class BallInOctree {
 public:
  explicit BallInOctree(const std::string& bt)
      : tree_(std::make_shared<octomap::OcTree>(bt)), geometry_(std::make_shared<fcl::OcTreed>(tree_)), map_(geometry_), ball_(std::make_shared<fcl::Sphered>(kRobotRadius)) {}

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

// The free place nearest to `p`: the camera passed there, but a voxel right at it may not have been crossed by a ray.
std::optional<Eigen::Vector3d> free_place_near(const BallInOctree& map, const Eigen::Vector3d& p) {
  for (double radius = 0; radius < 2; radius += 0.1)
    for (int i = 0; i < 16; ++i) {
      const Eigen::Vector3d q = p + radius * Eigen::Vector3d(std::cos(i * M_PI / 8), std::sin(i * M_PI / 8), 0);
      if (map.is_free(q)) return q;
    }
  return std::nullopt;
}

std::vector<Eigen::Vector3d> plan_3d(const BallInOctree& map, const Eigen::Vector3d& start, const Eigen::Vector3d& goal) {
  namespace ob = ompl::base;
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(1);
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
  OctreeMap(run_metres_, params_).write_bt(folder / "edges.bt");
  const BallInOctree map(folder / "edges.bt");
  const auto start = free_place_near(map, camera(kStart)), goal = free_place_near(map, camera(kGoal));
  ASSERT_TRUE(start && goal) << "no free place where the camera was";
  const std::vector<Eigen::Vector3d> path = plan_3d(map, *start, *goal);
  ASSERT_FALSE(path.empty()) << "no way found";
  double least = 10;
  for (const Eigen::Vector3d& p : path) least = std::min(least, truth_.distance(p, least));
  std::cout << "[ figures  ] a way of " << path.size() << " states over " << (*goal - *start).norm() << " m, at least " << least
            << " m from every true surface" << std::endl;
  EXPECT_GT(least, kTrueRadius);
}

TEST_F(Planning, MrptSimplePlannerOverTheGrid) {
  const test::TempFolder folder;
  GridParams grid_params;
  const double height = 1.65;
  write_gridmap(make_grid(run_metres_, OctreeMap(run_metres_, params_), height, grid_params), folder / "grid.gridmap.gz");
  mrpt::io::CFileGZInputStream file(folder / "grid.gridmap.gz");
  mrpt::maps::COccupancyGridMap2D grid;
  mrpt::serialization::archiveFrom(file) >> grid;
  mrpt::nav::PlannerSimple2D planner;
  planner.robotRadius = float(kRobotRadius);
  planner.occupancyThreshold = 0.6f;  // unknown (0.5) is no way
  std::deque<mrpt::math::TPoint2D> path;
  bool not_found = true;
  const Eigen::Vector3d start = camera(kStart), goal = camera(kGoal);
  planner.computePath(grid, {start.x(), start.y(), 0}, {goal.x(), goal.y(), 0}, path, not_found);
  ASSERT_FALSE(not_found);
  ASSERT_GT(path.size(), 10u);
  // The robot is a post from the lower end of the band to the camera.
  double least = 10;
  for (const auto& p : path)
    for (const double over_ground : {0.5, 1.0, 1.5})
      least = std::min(least, truth_.distance({p.x, p.y, start.z() - height + over_ground}, least));
  std::cout << "[ figures  ] a way of " << path.size() << " points, at least " << least << " m from every true surface" << std::endl;
  EXPECT_GT(least, kTrueRadius);
}

}  // namespace
}  // namespace edgevo::testing
