// SPDX-License-Identifier: BSD-3-Clause
// plan MAP.bt RADIUS  x y z  x y z  OUT: a path for a ball from the first position to the second, one
// position a line.
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

namespace ob = ompl::base;

int main(int argc, char** argv) {
  if (argc != 10) return std::fprintf(stderr, "usage: plan MAP.bt RADIUS x y z x y z OUT\n"), 2;
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  const auto tree = std::make_shared<octomap::OcTree>(argv[1]);
  const double radius = std::atof(argv[2]);
  double ends[6];
  for (int i = 0; i < 6; ++i) ends[i] = std::atof(argv[3 + i]);

  fcl::CollisionObjectd map(std::make_shared<fcl::OcTreed>(tree));
  const auto ball = std::make_shared<fcl::Sphered>(radius);
  // No occupied voxel touches the ball, and its centre was observed to be free.
  const auto is_free = [&](const ob::State* state) {
    const auto* p = state->as<ob::RealVectorStateSpace::StateType>()->values;
    const auto* node = tree->search(p[0], p[1], p[2]);
    if (!node || tree->isNodeOccupied(node)) return false;
    fcl::CollisionObjectd robot(ball, Eigen::Matrix3d::Identity(), Eigen::Vector3d(p[0], p[1], p[2]));
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(&robot, &map, request, result) == 0;
  };

  const auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds(3);
  for (unsigned i = 0; i < 3; ++i) {
    const double margin = i < 2 ? 10 : 1;  // metres
    bounds.setLow(i, std::min(ends[i], ends[3 + i]) - margin);
    bounds.setHigh(i, std::max(ends[i], ends[3 + i]) + margin);
  }
  space->setBounds(bounds);
  ompl::geometric::SimpleSetup setup(space);
  setup.setStateValidityChecker(is_free);
  setup.getSpaceInformation()->setStateValidityCheckingResolution(0.1 / space->getMaximumExtent());
  ob::ScopedState<> from(space), to(space);
  for (unsigned i = 0; i < 3; ++i) from[i] = ends[i], to[i] = ends[3 + i];
  setup.setStartAndGoalStates(from, to);
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
  if (setup.solve(60.0) != ob::PlannerStatus::EXACT_SOLUTION)
    return std::fprintf(stderr, "plan: no path found\n"), 3;
  setup.simplifySolution();
  setup.getSolutionPath().interpolate(100);
  std::ofstream out(argv[9]);
  setup.getSolutionPath().printAsMatrix(out);
}
