// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Planning for a ball through the octree of a run: OMPL's RRT-Connect, with FCL for collision checks.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octomap {
class OcTree;
}

namespace edgevo::test {

/// Collision checks of a ball in an octree. A position is free where no occupied voxel touches the ball and
/// its centre was observed to be free; unknown space counts as blocked.
class BallInOctree {
 public:
  BallInOctree(const std::string& bt, double radius);
  ~BallInOctree();

  /// Whether the ball can be at `p`.
  bool is_free(const Eigen::Vector3d& p) const;
  /// Share of the voxels with their centre in the ball that were observed to be free, 0 to 1.
  double share_free(const Eigen::Vector3d& p) const;
  /// The free position nearest to `p` at the same height, at most `reach` metres away. The camera passed
  /// there, but perhaps no ray crossed the voxel at the camera itself.
  std::optional<Eigen::Vector3d> free_position_near(const Eigen::Vector3d& p, double reach) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Seeds the sampling of all planners; call it once, before the first plan.
void seed_planner(unsigned seed);

/// Path of the ball from `start` to `goal`; empty where none was found within 60 s or `max_steps` iterations
/// of the planner.
std::vector<Eigen::Vector3d> plan_3d(const BallInOctree& map, const Eigen::Vector3d& start,
                                     const Eigen::Vector3d& goal, int max_steps = 1000000);

}  // namespace edgevo::test
