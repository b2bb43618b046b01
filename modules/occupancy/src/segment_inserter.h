#pragma once
// Keyframe after keyframe of one segment into an octree, each as one batch.
#include <octomap/OcTree.h>

#include <unordered_map>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"
#include "edgevo/occupancy/octree_map.h"
#include "point_cells.h"

namespace edgevo {

/// What is fixed for the whole map; lengths in its unit.
struct InsertionLimits {
  PointFilter points;
  double max_range = 0;
  double carve_max_relative_sigma = 0;
  int carve_neighbours = 0;
};

class SegmentInserter {
 public:
  /// `tree` and `stats` outlive this.
  SegmentInserter(const Pinhole& pinhole, const InsertionLimits& limits, octomap::OcTree* tree,
                  OctreeStats* stats);

  /// Notes where a keyframe and its points lie: all keyframes together tell which points have neighbours, and
  /// which places come near the path. Before the first insert().
  void note(const KeyframeRecord& keyframe, const SE3& T_map_cam);

  /// Adds a keyframe, in time order. Inner nodes of the tree are left behind (lazy). Cost: its rays, whatever
  /// the size of the tree. `T_map_cam`: its pose in the map's world.
  void insert(const KeyframeRecord& keyframe, const SE3& T_map_cam);

 private:
  bool may_carve(const EdgePoint& p, const Eigen::Vector3d& p_cam, const SE3& T_map_cam) const;
  double neighbour_radius(double range) const;
  bool has_neighbours(const Eigen::Vector3d& p_cam, const SE3& T_map_cam) const;
  bool is_in_reach(double range, double relative_sigma, const Eigen::Vector3d& p_map) const;
  /// Whether a voxel was marked; `range` from the keyframe.
  bool mark(const Eigen::Vector3d& p_map, double range, double relative_sigma, int observations);
  void draw(const EdgeLine& line, const SE3& T_map_cam);
  void note_seen(const octomap::OcTreeKey& key, int observations);
  void carve(const Eigen::Vector3d& p_cam, const SE3& T_map_cam, double relative_sigma);
  void update_tree();

  const Pinhole pinhole_;
  const InsertionLimits limits_;
  octomap::OcTree* const tree_;
  OctreeStats* const stats_;

  PointCells points_, path_;  ///< points and keyframes of the whole segment, in the map's world
  int batch_ = 0;             ///< number of the keyframe within the segment
  /// Voxels with a point, and the last batch that sees it. Each is updated once a batch, so the order does
  /// not matter.
  std::unordered_map<octomap::OcTreeKey, int, octomap::OcTreeKey::KeyHash> seen_until_;
  octomap::KeySet free_, ray_ends_;  ///< of the batch at hand
  octomap::KeyRay ray_;
};

}  // namespace edgevo
