#pragma once
// A rendered scene as the judge of a map made from it.
#include <octomap/OcTree.h>

#include <array>
#include <map>
#include <ostream>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/edges/edge_map.h"
#include "edgevo/occupancy/occupancy_params.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo::test {

struct MapQuality {
  int64_t occupied = 0, free = 0;  ///< voxels that were looked at
  double occupied_on_surface = 0;  ///< share of occupied voxels within one voxel of a true surface
  double free_behind_surface =
      0;  ///< share of free voxels of which no camera can have seen any part: inside or behind something
  double mapped_points_occupied =
      0;  ///< share of the run's exported points in range whose voxel is occupied: what carving has left
  double true_edges_occupied =
      0;  ///< share of the voxels with well-observed true edges that are occupied, or a neighbour is
  double crossing_edges_occupied = 0;  ///< the same for those that do not run along the motion of the camera,
                                       ///< which cannot tell their depth
  int64_t true_edge_voxels = 0;
};
std::ostream& operator<<(std::ostream& out, const MapQuality& quality);

struct EdgeCell;

class TrueScene {
 public:
  /// The run's path is laid onto the true one by a rigid motion.
  TrueScene(const SceneRenderer& renderer, const Run& run);

  MapQuality judge(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params) const;

  /// Distance of a point of the map from the nearest true surface, not looked for beyond `limit`.
  double distance(const Eigen::Vector3d& p_map, double limit) const;
  /// Where a way comes nearest to a true surface, looked at every five centimetres; not beyond 10 m.
  struct Nearest {
    double distance = 10;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< in the map
    const Surface* surface = nullptr;
  };
  Nearest nearest(const std::vector<Eigen::Vector3d>& way_map) const;

  /// From the scene to the map.
  SE3 T_map_scene() const { return T_scene_map_.inverse(); }
  /// The keyframes that see a point of the scene, nearer than `range`, with nothing `tolerance` in front.
  int keyframes_that_see(const Eigen::Vector3d& p_scene, double range, double tolerance) const;

 private:
  struct View {
    SE3 T_cam_scene;
    std::vector<float> depth;
  };
  void judge_voxels(const octomap::OcTree& tree, MapQuality* quality) const;
  void judge_points(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params,
                    MapQuality* quality) const;
  void judge_edges(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params,
                   MapQuality* quality) const;
  /// Of keyframe `k`, nearer than `range`, to the voxels in which they truly lie.
  void add_edges(const std::vector<EdgePixel>& edges, size_t k, double voxel, double range,
                 std::map<std::array<int, 3>, EdgeCell>* cells) const;
  bool is_seen_through(const Eigen::Vector3d& p_scene, double tolerance) const;
  bool is_any_part_seen_through(const Eigen::Vector3d& centre_map, double voxel) const;

  const SceneRenderer* renderer_;
  SE3 T_scene_map_;
  std::vector<View> views_;  ///< of the keyframes
};

}  // namespace edgevo::test
