// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Inserts the keyframes of one segment into an octree, each as one batch.
#include <octomap/OcTree.h>

#include <unordered_map>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"
#include "edgevo/occupancy/octree_map.h"
#include "point_cells.h"
#include "voxel_updates.h"

namespace edgevo {

/// Constants of a map; lengths in its unit.
struct InsertionLimits {
  PointFilter points;
  double max_range = 0;
  double carve_max_relative_sigma = 0;
  int carve_neighbours = 0;
};

/// Inserts one segment.
class SegmentInserter {
 public:
  /// `tree` and `stats` must outlive this object.
  SegmentInserter(const Pinhole& pinhole, const InsertionLimits& limits, octomap::OcTree* tree,
                  OctreeStats* stats);

  /// Registers the positions of a keyframe and its points. Call for all keyframes before the first insert():
  /// they determine which points have neighbours and which positions are near the path.
  void note(const KeyframeRecord& keyframe, const SE3& T_map_cam);

  /// Inserts a keyframe; call in time order. Inner nodes of the tree are not updated (lazy). Cost: the rays
  /// of the keyframe, whatever the size of the tree. `T_map_cam`: pose in the map's world.
  void insert(const KeyframeRecord& keyframe, const SE3& T_map_cam);

 private:
  bool may_carve(const EdgePoint& p, const Eigen::Vector3d& p_cam, const SE3& T_map_cam) const;
  double neighbour_radius(double range) const;
  bool has_neighbours(const Eigen::Vector3d& p_cam, const SE3& T_map_cam) const;
  bool is_in_reach(double range, double relative_sigma, const Eigen::Vector3d& p_map) const;
  /// Marks the voxel of a point at `range` from the keyframe. Returns whether it was marked.
  bool mark(const Eigen::Vector3d& p_map, double range, double relative_sigma, int observations);
  void draw(const EdgeLine& line, const SE3& T_map_cam);
  void note_seen(const octomap::OcTreeKey& key, int observations);
  void carve(const Eigen::Vector3d& p_cam, const SE3& T_map_cam, double relative_sigma);
  void update_tree();

  const Pinhole pinhole_;
  const InsertionLimits limits_;
  octomap::OcTree* const tree_;
  OctreeStats* const stats_;

  /// Positions of points and keyframes of the whole segment, in the map's world.
  PointCells points_, path_;
  /// Index of the keyframe within the segment.
  int batch_ = 0;
  bool are_fused_ = false;  // whether lines say how many keyframes have seen them
  /// Voxels with a point, and the last batch in which it counts as observed. Each is updated once a batch, so
  /// the order does not matter.
  std::unordered_map<octomap::OcTreeKey, int, octomap::OcTreeKey::KeyHash> seen_until_;
  /// Free voxels and end voxels of rays of the current batch.
  octomap::KeySet free_, ray_ends_;
  octomap::KeyRay ray_;
  VoxelUpdates updates_;
};

}  // namespace edgevo
