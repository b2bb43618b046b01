#pragma once
// A ball that a stock planner leads through the octree of a run: OMPL's RRT-Connect, with FCL for collisions.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace octomap {
class OcTree;
}

namespace edgevo::test {

/// A ball may be where nothing occupied touches it, and where its middle was seen to be free: unknown is no
/// way.
class BallInOctree {
 public:
  BallInOctree(const std::string& bt, double radius);
  ~BallInOctree();

  bool is_free(const Eigen::Vector3d& p) const;
  /// Share of the voxels with their middle in the ball that were seen to be free.
  double share_free(const Eigen::Vector3d& p) const;
  /// The free place nearest to `p` at its height, at most `reach` away: the camera passed there, but a voxel
  /// right at it may not have been crossed by a ray.
  std::optional<Eigen::Vector3d> free_place_near(const Eigen::Vector3d& p, double reach) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Lets every planner that follows sample alike. Once, before the first.
void seed_planner(unsigned seed);

/// Empty: none found in 60 s or `most_steps` of the planner.
std::vector<Eigen::Vector3d> plan_3d(const BallInOctree& map, const Eigen::Vector3d& start,
                                     const Eigen::Vector3d& goal, int most_steps = 1000000);

}  // namespace edgevo::test
