// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A rendered scene as ground truth for a map made from it.
#include <octomap/OcTree.h>

#include <array>
#include <map>
#include <ostream>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/occupancy/occupancy_params.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo::test {

struct MapQuality {
  /// Numbers of occupied and free voxels.
  int64_t occupied = 0, free = 0;
  /// Share of occupied voxels within one voxel of a true surface.
  double occupied_on_surface = 0;
  /// Share of free voxels that no camera can have seen any part of: inside or behind a surface.
  double free_behind_surface = 0;
  /// Share of the run's exported points in range whose voxel is still occupied after carving.
  double mapped_points_occupied = 0;
  /// Share of the voxels with well-observed true edges where the voxel or a neighbour is occupied.
  double true_edges_occupied = 0;
  /// Share for the edges across the camera motion only; the depth of edges along it is not observable.
  double crossing_edges_occupied = 0;
  int64_t true_edge_voxels = 0;
};
std::ostream& operator<<(std::ostream& out, const MapQuality& quality);

struct EdgeCell;

class TrueScene {
 public:
  /// Aligns the path of the run with the true one by a rigid motion.
  TrueScene(const SceneRenderer& renderer, const Run& run);

  /// Compares an octree and the points of `run` with the true surfaces.
  MapQuality evaluate(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params) const;

  /// Distance in metres of a point in the map frame from the nearest true surface; at most `limit`.
  double distance(const Eigen::Vector3d& p_map, double limit) const;
  /// Where a path comes nearest to a true surface, sampled every five centimetres; at most 10 m.
  struct Nearest {
    double distance = 10;
    /// Position in the map frame.
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    const Surface* surface = nullptr;
  };
  Nearest nearest(const std::vector<Eigen::Vector3d>& path_map) const;

  /// Pose of the scene in the map frame.
  SE3 T_map_scene() const { return T_scene_map_.inverse(); }
  /// Number of keyframes that see a point of the scene, nearer than `range` and with no surface more than
  /// `tolerance` in front of it, metres.
  int keyframes_that_see(const Eigen::Vector3d& p_scene, double range, double tolerance) const;

 private:
  struct View {
    SE3 T_cam_scene;
    std::vector<float> depth;
  };
  void evaluate_voxels(const octomap::OcTree& tree, MapQuality* quality) const;
  void evaluate_points(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params,
                       MapQuality* quality) const;
  void evaluate_edges(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params,
                      MapQuality* quality) const;
  /// Adds the edge pixels of keyframe `k` that are nearer than `range` to the voxels of their true positions.
  void add_edges(const std::vector<EdgePixel>& edges, size_t k, double voxel, double range,
                 std::map<std::array<int, 3>, EdgeCell>* cells) const;
  bool is_seen_through(const Eigen::Vector3d& p_scene, double tolerance) const;
  bool is_any_part_seen_through(const Eigen::Vector3d& centre_map, double voxel) const;

  const SceneRenderer* renderer_;
  SE3 T_scene_map_;
  /// True pose and depth image of each keyframe.
  std::vector<View> views_;
};

}  // namespace edgevo::test
