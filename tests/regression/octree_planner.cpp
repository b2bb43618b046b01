// SPDX-License-Identifier: BSD-3-Clause
#include "octree_planner.h"

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>

namespace edgevo::test {

struct BallInOctree::Impl {
  Impl(const std::string& bt, double radius)
      : tree(std::make_shared<octomap::OcTree>(bt)),
        geometry(std::make_shared<fcl::OcTreed>(tree)),
        map(geometry),
        ball(std::make_shared<fcl::Sphered>(radius)) {}

  std::shared_ptr<octomap::OcTree> tree;
  std::shared_ptr<fcl::OcTreed> geometry;
  fcl::CollisionObjectd map;
  std::shared_ptr<fcl::Sphered> ball;
};

BallInOctree::BallInOctree(const std::string& bt, double radius)
    : impl_(std::make_unique<Impl>(bt, radius)) {}
BallInOctree::~BallInOctree() = default;

bool BallInOctree::is_free(const Eigen::Vector3d& p) const {
  const auto* node = impl_->tree->search(p.x(), p.y(), p.z());
  if (!node || impl_->tree->isNodeOccupied(node)) return false;
  fcl::CollisionObjectd ball(impl_->ball, Eigen::Matrix3d::Identity(), p);
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&ball, &impl_->map, request, result) == 0;
}

double BallInOctree::share_free(const Eigen::Vector3d& p) const {
  const double voxel = impl_->tree->getResolution(), radius = impl_->ball->radius;
  const int reach = int(radius / voxel) + 1;
  int all = 0, free = 0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        const Eigen::Vector3d middle =
            voxel * ((p / voxel).array().floor().matrix() + Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5));
        if ((middle - p).norm() > radius) continue;
        const auto* node = impl_->tree->search(middle.x(), middle.y(), middle.z());
        ++all, free += node && !impl_->tree->isNodeOccupied(node);
      }
  return double(free) / double(std::max(1, all));
}

std::optional<Eigen::Vector3d> BallInOctree::free_position_near(const Eigen::Vector3d& p,
                                                                double reach) const {
  for (double radius = 0; radius < reach; radius += 0.1)
    for (int i = 0; i < 16; ++i) {
      const Eigen::Vector3d q =
          p + radius * Eigen::Vector3d(std::cos(i * M_PI / 8), std::sin(i * M_PI / 8), 0);
      if (is_free(q)) return q;
    }
  return std::nullopt;
}

void seed_planner(unsigned seed) { ompl::RNG::setSeed(seed); }

std::vector<Eigen::Vector3d> plan_3d(const BallInOctree& map, const Eigen::Vector3d& start,
                                     const Eigen::Vector3d& goal, int max_steps) {
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
  int steps = 0;
  const ob::PlannerTerminationCondition enough([&] { return ++steps > max_steps; });
  std::vector<Eigen::Vector3d> path;
  if (setup.solve(ob::plannerOrTerminationCondition(enough, ob::timedPlannerTerminationCondition(60.0))) !=
      ob::PlannerStatus::EXACT_SOLUTION)
    return path;
  setup.getSolutionPath().interpolate();
  for (const ob::State* s : setup.getSolutionPath().getStates()) path.push_back(position(s));
  return path;
}

}  // namespace edgevo::test
