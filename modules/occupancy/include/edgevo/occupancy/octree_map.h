#pragma once
// The edge map as an occupancy octree (OctoMap), for planners: octomap_server, MoveIt, FCL, octovis.
//
// World: T_map_world(run), z up and x forward. Unit: that of the run; the comments in the files' headers
// state it.
//
// Each keyframe is one batch, as in octomap::OcTree::insertPointCloud(lazy, discretized), where occupied wins
// over free. What differs from it, because edges are thin and sparse:
//  - Only certain points carve free space, and their rays stop some sigmas of depth (and a voxel) before the
//    point. Rays up to the point let neighbouring rays erase the edge itself: a thin edge covers one voxel of
//    each ray's path, its depth error several.
//  - A point carves only where others of its segment lie near it (carve_neighbours). An outlier leaves a
//    point metres behind the surface whose sigma is small, but no others beside it; its ray would free the
//    inside of walls.
//  - The records hold each point once, in its host, although several keyframes saw it. A point with n
//    observations counts as seen in its host's batch and the n - 1 after it: there its voxel is hit and not
//    carved. Counted once, an edge that was matched ten times would be erased by the rays of three keyframes
//    that graze its voxel.
//  - Segments are mapped apart and joined by "occupied in any, else free in any": between segments neither
//    scale nor place is measured, so that a ray of one proves nothing about the edges of another.
// Between edges lies unknown space. A planner has to choose whether unknown is free; free voxels here are
// really seen ones.
//
// Cost: about as many voxel visits as rays times range over resolution; see
// share/lab/archive/2026-11-21_octomap_insertion.md. Not thread-safe; no
// OpenMP, whose number of threads octomap's own insertion would reset. A run without points gives an empty,
// valid map.
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

/// What went into the map, for summary.yaml.
struct OctreeStats {
  PointCounts points;            ///< which of them were mapped, and why not
  double median_depth = 0;       ///< of the kept points, in their host cameras; 0: no points
  double resolution = 0;         ///< as used
  double max_range = 0;          ///< as used
  int batches = 0;               ///< keyframes inserted
  std::vector<double> batch_ms;  ///< CPU milliseconds of each
  int rays = 0;                  ///< rays that carved, after those with the same end voxel were dropped
  int beyond_range = 0;   ///< kept points and vertices of lines not marked because they lie beyond max_range
  int out_of_bounds = 0;  ///< kept points outside the octree (32768 voxels from the origin)
  int64_t occupied_voxels = 0, free_voxels = 0;  ///< of the finest size
};

/// Told with the number of keyframes inserted so far.
using OnKeyframeMapped = std::function<void(int)>;

/// The octree of one run.
class OctreeMap {
 public:
  /// Throws InputError for parameters that check() refuses. How large it gets: map_size.h.
  OctreeMap(const Run& run, const OccupancyParams& params, const OnKeyframeMapped& on_keyframe = {});
  ~OctreeMap();
  OctreeMap(OctreeMap&&) noexcept;
  OctreeMap& operator=(OctreeMap&&) noexcept;

  const octomap::OcTree& tree() const { return *tree_; }  ///< log-odds; valid while this object lives
  const OctreeStats& stats() const { return stats_; }     ///< what went into it

  /// Occupied or free only, the smallest and most widely read format. Throws InputError when it cannot be
  /// written.
  void write_bt(const std::string& path) const;
  /// With log-odds. Throws InputError when it cannot be written.
  void write_ot(const std::string& path) const;

 private:
  std::unique_ptr<octomap::OcTree> tree_;
  OctreeStats stats_;
  std::string comments_;
};

}  // namespace edgevo
