// SPDX-License-Identifier: BSD-3-Clause
#include "true_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "edgevo/core/point_filter.h"
#include "edgevo/edges/frame_pyramid.h"
#include "surface_distance.h"

namespace edgevo::test {

/// The edge pixels whose true positions lie in one voxel.
struct EdgeCell {
  std::map<size_t, int> pixels;  // of each keyframe
  int all = 0;
  double across = 0;  // sum of |cos| between edge normal and epipolar line

  void add(size_t keyframe, const EdgePixel& e, const Eigen::Vector2d& epipolar) {
    ++pixels[keyframe], ++all;
    across += std::abs(Eigen::Vector2d(double(e.nx), double(e.ny)).normalized().dot(epipolar));
  }
  bool is_well_observed() const {
    return std::count_if(pixels.begin(), pixels.end(), [](const auto& p) { return p.second >= 5; }) >= 5;
  }
  /// Whether the edges cross the motion by twelve degrees or more: motion along an edge does not determine
  /// its depth.
  bool crosses_the_motion() const { return across >= 0.2 * all; }
};

namespace {

constexpr int kEveryFree = 7;  // every n-th free voxel is tested: there are hundreds of thousands

double share(int64_t part, int64_t all) { return double(part) / double(std::max<int64_t>(1, all)); }

bool is_occupied(const octomap::OcTree& tree, const Eigen::Vector3d& p) {
  const auto* node = tree.search(p.x(), p.y(), p.z());
  return node && tree.isNodeOccupied(node);
}

// The voxel or one of its neighbours.
bool is_occupied_around(const octomap::OcTree& tree, const std::array<int, 3>& cell, double voxel) {
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dz = -1; dz <= 1; ++dz)
        if (is_occupied(tree,
                        voxel * Eigen::Vector3d(cell[0] + dx + 0.5, cell[1] + dy + 0.5, cell[2] + dz + 0.5)))
          return true;
  return false;
}

Eigen::Vector3d centre(const octomap::OcTree& tree, const octomap::OcTreeKey& key) {
  const octomap::point3d p = tree.keyToCoord(key);
  return {double(p.x()), double(p.y()), double(p.z())};
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const MapQuality& q) {
  return out << q.occupied << " occupied voxels, " << 100 * q.occupied_on_surface << " % on a surface; "
             << q.free << " free, " << 100 * q.free_behind_surface << " % behind one; "
             << 100 * q.mapped_points_occupied << " % of the points' voxels kept; "
             << 100 * q.true_edges_occupied << " % of " << q.true_edge_voxels
             << " voxels of true edges occupied, " << 100 * q.crossing_edges_occupied
             << " % of those across the motion";
}

TrueScene::TrueScene(const SceneRenderer& renderer, const Run& run) : renderer_(&renderer) {
  const SE3 T_map = T_map_world(run);
  std::vector<Eigen::Vector3d> map, scene;
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam) continue;
    map.push_back((T_map * *f.T_world_cam).translation());
    scene.push_back(renderer.scene().T_scene_cam[size_t(f.index)].translation());
  }
  // A straight path leaves the roll undetermined; a second point a metre above each camera fixes it.
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam) continue;
    const Eigen::Vector3d up(0, -1, 0);
    map.push_back(T_map * *f.T_world_cam * up);
    scene.push_back(renderer.scene().T_scene_cam[size_t(f.index)] * up);
  }
  Eigen::Matrix3Xd a(3, map.size()), b(3, scene.size());
  for (size_t i = 0; i < map.size(); ++i) a.col(Eigen::Index(i)) = map[i], b.col(Eigen::Index(i)) = scene[i];
  const Eigen::Matrix4d T = Eigen::umeyama(a, b, false);
  T_scene_map_ = SE3(Eigen::Matrix3d(T.topLeftCorner<3, 3>()), Eigen::Vector3d(T.topRightCorner<3, 1>()));
  for (const KeyframeRecord& k : run.keyframes)
    views_.push_back({renderer.scene().T_scene_cam[size_t(k.frame_index)].inverse(),
                      renderer.render_depth(k.frame_index)});
}

double TrueScene::distance(const Eigen::Vector3d& p_map, double limit) const {
  const Eigen::Vector3d p = T_scene_map_ * p_map;
  double least = limit;
  const World& world = *renderer_->scene().world;
  for (const Surface& s : world.surfaces) least = std::min(least, distance_to(world, s, p, least));
  return least;
}

TrueScene::Nearest TrueScene::nearest(const std::vector<Eigen::Vector3d>& path) const {
  const World& world = *renderer_->scene().world;
  Nearest nearest;
  for (size_t i = 1; i < path.size(); ++i) {
    const int steps = 1 + int((path[i] - path[i - 1]).norm() / 0.05);
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector3d p_map = path[i - 1] + (path[i] - path[i - 1]) * k / steps,
                            p = T_scene_map_ * p_map;
      for (const Surface& s : world.surfaces) {
        const double d = distance_to(world, s, p, nearest.distance);
        if (d < nearest.distance) nearest = {d, p_map, &s};
      }
    }
  }
  return nearest;
}

int TrueScene::keyframes_that_see(const Eigen::Vector3d& p_scene, double range, double tolerance) const {
  const Pinhole pinhole = renderer_->camera().pinhole();
  int seen = 0;
  for (const View& view : views_) {
    const Eigen::Vector3d p = view.T_cam_scene * p_scene;
    if (p.z() < 0.1 || p.norm() > range) continue;
    const Eigen::Vector2d px = pinhole.project(p);
    if (!pinhole.contains(px, 3)) continue;
    const float depth =
        view.depth[size_t(std::lround(px.y())) * size_t(pinhole.width) + size_t(std::lround(px.x()))];
    seen += depth == 0 || double(depth) > p.z() - tolerance;
  }
  return seen;
}

// Whether some keyframe sees the point, with no surface nearer than it by more than the tolerance.
bool TrueScene::is_seen_through(const Eigen::Vector3d& p_scene, double tolerance) const {
  const Pinhole pinhole = renderer_->camera().pinhole();
  for (const View& view : views_) {
    const Eigen::Vector3d p = view.T_cam_scene * p_scene;
    if (p.z() < 0.1) {
      if (p.norm() < 1) return true;  // the camera was there
      continue;
    }
    const Eigen::Vector2d px = pinhole.project(p);
    if (!pinhole.contains(px, 1)) continue;
    const float depth =
        view.depth[size_t(std::lround(px.y())) * size_t(pinhole.width) + size_t(std::lround(px.x()))];
    if (depth == 0 || double(depth) > p.z() - tolerance) return true;
  }
  return false;
}

bool TrueScene::is_any_part_seen_through(const Eigen::Vector3d& centre_map, double voxel) const {
  constexpr double kTolerance = 0.05;  // metres: rotation errors of the path times the depth
  for (int corner = -1; corner < 8; ++corner) {
    const Eigen::Vector3d sides(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Eigen::Vector3d p_map = corner < 0 ? centre_map : Eigen::Vector3d(centre_map + 0.5 * voxel * sides);
    if (is_seen_through(T_scene_map_ * p_map, kTolerance)) return true;
  }
  return false;
}

MapQuality TrueScene::evaluate(const octomap::OcTree& tree, const Run& run,
                               const OccupancyParams& params) const {
  MapQuality quality;
  evaluate_voxels(tree, &quality);
  evaluate_points(tree, run, params, &quality);
  evaluate_edges(tree, run, params, &quality);
  return quality;
}

void TrueScene::evaluate_voxels(const octomap::OcTree& tree, MapQuality* quality) const {
  const double voxel = tree.getResolution(), half_diagonal = 0.5 * std::sqrt(3.0) * voxel;
  octomap::OcTree voxels(tree);
  voxels.expand();
  int64_t on_surface = 0, behind = 0, tested = 0;
  for (auto leaf = voxels.begin_leafs(), end = voxels.end_leafs(); leaf != end; ++leaf) {
    const Eigen::Vector3d p = centre(voxels, leaf.getKey());
    if (voxels.isNodeOccupied(*leaf)) {
      ++quality->occupied;
      // Some point of the voxel is within one voxel.
      on_surface += distance(p, 2 * voxel) <= voxel + half_diagonal;
    } else if (++quality->free % kEveryFree == 0) {
      behind += !is_any_part_seen_through(p, voxel);
      ++tested;
    }
  }
  quality->occupied_on_surface = share(on_surface, quality->occupied);
  quality->free_behind_surface = share(behind, tested);
}

void TrueScene::evaluate_points(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params,
                                MapQuality* quality) const {
  const SE3 T_map = T_map_world(run);
  int64_t points = 0, kept = 0;
  for (const KeyframeRecord& k : run.keyframes)
    for (const EdgePoint& e : k.points) {
      const Eigen::Vector3d p_cam = point_in_camera(run.pinhole, e);
      if (!params.points.keeps(e) || p_cam.norm() > params.given_max_range()) continue;
      ++points;
      kept += is_occupied(tree, T_map * k.T_world_cam * p_cam);
    }
  quality->mapped_points_occupied = share(kept, points);
}

// True edges: edge pixels of the keyframes at their true depth. Well observed: five pixels in each of five
// keyframes within half the range.
void TrueScene::evaluate_edges(const octomap::OcTree& tree, const Run& run, const OccupancyParams& params,
                               MapQuality* quality) const {
  const double voxel = tree.getResolution();
  std::map<std::array<int, 3>, EdgeCell> cells;
  PyramidBuilder builder(renderer_->camera(), EdgeParams());
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    const auto pyramid = builder.build(renderer_->render_image(run.keyframes[k].frame_index));
    add_edges(pyramid->finest().edges.pixels, k, voxel, 0.5 * params.given_max_range(), &cells);
  }
  int64_t found = 0, crossing = 0, crossing_found = 0;
  for (const auto& [at, cell] : cells) {
    if (!cell.is_well_observed()) continue;
    const bool is_found = is_occupied_around(tree, at, voxel);
    ++quality->true_edge_voxels, found += is_found;
    if (cell.crosses_the_motion()) ++crossing, crossing_found += is_found;
  }
  quality->true_edges_occupied = share(found, quality->true_edge_voxels);
  quality->crossing_edges_occupied = share(crossing_found, crossing);
}

void TrueScene::add_edges(const std::vector<EdgePixel>& edges, size_t k, double voxel, double range,
                          std::map<std::array<int, 3>, EdgeCell>* cells) const {
  const Pinhole pinhole = renderer_->camera().pinhole();
  const SE3 T_map_cam = T_scene_map_.inverse() * views_[k].T_cam_scene.inverse();
  const size_t next = k + 1 < views_.size() ? k + 1 : k - 1;
  const Eigen::Vector2d epipole =
      pinhole.project((views_[k].T_cam_scene * views_[next].T_cam_scene.inverse()).translation());
  for (const EdgePixel& e : edges) {
    const Eigen::Vector2d px = e.position().cast<double>();
    const float z =
        views_[k].depth[size_t(std::lround(px.y())) * size_t(pinhole.width) + size_t(std::lround(px.x()))];
    const Eigen::Vector3d p_cam = double(z) * pinhole.ray(px);
    if (!(z > 0) || p_cam.norm() > range) continue;
    const Eigen::Vector3d p = T_map_cam * p_cam / voxel;
    (*cells)[{int(std::floor(p.x())), int(std::floor(p.y())), int(std::floor(p.z()))}].add(
        k, e, (px - epipole).normalized());
  }
}

}  // namespace edgevo::test
