// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edge map as an occupancy octree (OctoMap), for planners: octomap_server, MoveIt, FCL, octovis.
//
// World: T_map_world(run), z up and x forward. Unit: that of the run; the comments in the files' headers
// state it.
//
// Each keyframe is one batch, as in octomap::OcTree::insertPointCloud(lazy, discretized), where occupied wins
// over free. Differences, because edges are thin and sparse:
//  - Only points with a small depth uncertainty carve free space, and their rays stop some sigmas of depth
//    (and a voxel) before the point. With rays up to the point, neighbouring rays would erase the edge: a
//    thin edge covers one voxel of each ray, its depth error several.
//  - A point carves only if other points of its segment are near (carve_neighbours). An outlier may lie
//    metres behind the surface with a small sigma, but alone; its ray would free the inside of walls.
//  - The records hold each point once, in its host, although several keyframes observed it. A point with n
//    observations counts as observed in the batch of its host and the n - 1 batches after it, in which its
//    voxel is hit and not carved. Counted once, an edge that was matched ten times would be erased by the
//    rays of three keyframes that graze its voxel.
//  - Segments are mapped separately and merged as "occupied in any, else free in any": neither scale nor
//    position is measured between segments, so a ray of one proves nothing about the edges of another.
// Space between edges is unknown. A planner has to decide whether to treat it as free; voxels marked free
// were observed.
//
// Cost: number of rays times range over resolution, in voxel visits; see
// lab 2026-11-21_octomap_insertion. Not thread-safe. Does not use OpenMP, whose number of
// threads octomap's own insertion would reset. A run without points gives an empty, valid map.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"
#include "edgevo/occupancy/occupancy_params.h"

namespace octomap {
class OcTree;
}

namespace edgevo {

/// Statistics of the map, for summary.yaml.
struct OctreeStats {
  /// Number of points that were mapped, and of those that were not, by reason.
  PointCounts points;
  /// Median depth of the kept points in their host cameras; 0: no points.
  double median_depth = 0;
  /// Voxel size used, unit of the run.
  double resolution = 0;
  /// Largest range used, unit of the run.
  double max_range = 0;
  /// Number of keyframes inserted.
  int batches = 0;
  /// CPU time of each batch, milliseconds.
  std::vector<double> batch_ms;
  /// Number of rays that carved free space, one for each end voxel of a batch.
  int rays = 0;
  /// Number of kept points and line vertices that were not mapped because they lie beyond max_range.
  int beyond_range = 0;
  /// Number of kept points outside the octree (32768 voxels from the origin).
  int out_of_bounds = 0;
  /// Number of occupied and free voxels, counted at the finest size.
  int64_t occupied_voxels = 0, free_voxels = 0;
};

/// Progress callback; called with the number of keyframes inserted so far.
using OnKeyframeMapped = std::function<void(int)>;

/// The octree of one run.
class OctreeMap {
 public:
  /// Makes the map. Throws InputError for parameters that check() refuses. Size in advance: map_size.h.
  OctreeMap(const Run& run, const OccupancyParams& params, const OnKeyframeMapped& on_keyframe = {});
  ~OctreeMap();
  OctreeMap(OctreeMap&&) noexcept;
  OctreeMap& operator=(OctreeMap&&) noexcept;

  /// The octree with log-odds; valid while this object lives.
  const octomap::OcTree& tree() const { return *tree_; }
  /// Statistics of the map.
  const OctreeStats& stats() const { return stats_; }

  /// Writes occupied or free only (.bt), the smallest and most widely read format. Throws InputError if the
  /// file cannot be written.
  void write_bt(const std::string& path) const;
  /// Writes log-odds (.ot). Throws InputError if the file cannot be written.
  void write_ot(const std::string& path) const;

 private:
  std::unique_ptr<octomap::OcTree> tree_;
  OctreeStats stats_;
  std::string comments_;
};

}  // namespace edgevo
