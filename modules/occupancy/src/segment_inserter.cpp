// SPDX-License-Identifier: BSD-3-Clause
#include "segment_inserter.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "edgevo/core/depth_source.h"

namespace edgevo {
namespace {

template <class PointOrVertex>
double relative_sigma(const PointOrVertex& p) {
  return double(p.idepth_sigma) / double(p.idepth);
}

// What is in front of a plane and was taken for a mark on it is seen there from one keyframe alone.
bool is_confirmed(const EdgeLine& line) { return line.source != DepthSource::kPlane || line.keyframes > 1; }

// Multiple of the range of the map (points beyond the range carve up to it). The radius of the neighbour
// search does not grow beyond this distance.
constexpr double kFarthest = 2;

// A ray ends so many standard deviations of depth before the point.
constexpr double kStopSigmas = 3;
// Radius of the neighbour search as a share of a point's range.
constexpr double kNeighbourShare = 0.03;
// Diagonal of a voxel over its edge: the ray ends outside the voxel of the point.
const double kDiagonal = std::sqrt(3.0);

octomap::point3d to_octomap(const Eigen::Vector3d& p) { return {float(p.x()), float(p.y()), float(p.z())}; }

}  // namespace

SegmentInserter::SegmentInserter(const Pinhole& pinhole, const InsertionLimits& limits, octomap::OcTree* tree,
                                 OctreeStats* stats)
    : pinhole_(pinhole),
      limits_(limits),
      tree_(tree),
      stats_(stats),
      points_(std::max(neighbour_radius(kFarthest * limits.max_range), tree->getResolution())),
      path_(limits.max_range) {}

void SegmentInserter::note(const KeyframeRecord& keyframe, const SE3& T_map_cam) {
  octomap::OcTreeKey key;
  if (tree_->coordToKeyChecked(to_octomap(T_map_cam.translation()), key)) path_.add(T_map_cam.translation());
  for (const EdgeLine& line : keyframe.lines) are_fused_ |= line.keyframes > 1;
  for (const EdgePoint& p : keyframe.points) {
    if (!limits_.points.keeps(p)) continue;
    const Eigen::Vector3d p_map = T_map_cam * point_in_camera(pinhole_, p);
    if (tree_->coordToKeyChecked(to_octomap(p_map), key)) points_.add(p_map);
  }
}

void SegmentInserter::insert(const KeyframeRecord& keyframe, const SE3& T_map_cam) {
  free_.clear();
  ray_ends_.clear();
  for (const EdgePoint& p : keyframe.points) {
    if (!limits_.points.keeps(p)) continue;
    const Eigen::Vector3d p_cam = point_in_camera(pinhole_, p);
    mark(T_map_cam * p_cam, p_cam.norm(), relative_sigma(p), p.observations);
    if (may_carve(p, p_cam, T_map_cam)) carve(p_cam, T_map_cam, relative_sigma(p));
  }
  for (const EdgeLine& line : keyframe.lines)
    if (!are_fused_ || is_confirmed(line)) draw(line, T_map_cam);
  update_tree();
  ++batch_;
  ++stats_->batches;
}

bool SegmentInserter::may_carve(const EdgePoint& p, const Eigen::Vector3d& p_cam,
                                const SE3& T_map_cam) const {
  return relative_sigma(p) <= limits_.carve_max_relative_sigma && has_neighbours(p_cam, T_map_cam);
}

double SegmentInserter::neighbour_radius(double range) const {
  return kNeighbourShare * std::min(range, kFarthest * limits_.max_range);
}

// Outliers lie far behind the surface with a small sigma (depth off by 20 to 300 sigmas), but each alone.
bool SegmentInserter::has_neighbours(const Eigen::Vector3d& p_cam, const SE3& T_map_cam) const {
  const int with_itself = limits_.carve_neighbours + 1;
  return limits_.carve_neighbours == 0 ||
         points_.has_within(T_map_cam * p_cam, neighbour_radius(p_cam.norm()), with_itself);
}

// A point beyond the range counts if the path comes within range of it later and its depth is known to a
// voxel: the top of a lamp leaves the view long before the camera is there.
bool SegmentInserter::is_in_reach(double range, double relative_sigma, const Eigen::Vector3d& p_map) const {
  return range <= limits_.max_range ||
         (relative_sigma * range <= tree_->getResolution() && path_.has_within(p_map, limits_.max_range, 1));
}

bool SegmentInserter::mark(const Eigen::Vector3d& p_map, double range, double relative_sigma,
                           int observations) {
  octomap::OcTreeKey key;
  if (!tree_->coordToKeyChecked(to_octomap(p_map), key)) {
    ++stats_->out_of_bounds;
    return false;
  }
  if (!is_in_reach(range, relative_sigma, p_map)) {
    ++stats_->beyond_range;
    return false;
  }
  note_seen(key, observations);
  return true;
}

void SegmentInserter::note_seen(const octomap::OcTreeKey& key, int observations) {
  const auto [entry, is_new] = seen_until_.emplace(key, batch_);
  entry->second = std::max(entry->second, batch_ + std::max(observations, 1) - 1);
}

// Marks the voxels of a line from vertex to vertex, where its depth is known to half a voxel.
void SegmentInserter::draw(const EdgeLine& line, const SE3& T_map_cam) {
  std::optional<octomap::point3d> before;
  for (const EdgeVertex& v : line.vertices) {
    const Eigen::Vector3d p_cam = point_in_camera(pinhole_, v), p_map = T_map_cam * p_cam;
    const bool is_certain = relative_sigma(v) * p_cam.norm() <= 0.5 * tree_->getResolution();
    const bool is_marked = is_certain && mark(p_map, p_cam.norm(), relative_sigma(v), line.keyframes);
    const octomap::point3d here = to_octomap(p_map);
    if (is_marked && before && tree_->computeRayKeys(*before, here, ray_))
      for (const octomap::OcTreeKey& between : ray_) note_seen(between, line.keyframes);
    before.reset();
    if (is_marked) before = here;
  }
}

void SegmentInserter::carve(const Eigen::Vector3d& p_cam, const SE3& T_map_cam, double relative_sigma) {
  const double range = p_cam.norm();
  // To first order, sigma of depth over depth equals sigma of inverse depth over inverse depth.
  const double margin = std::max(kStopSigmas * relative_sigma * range, kDiagonal * tree_->getResolution());
  const double length = std::min(range - margin, limits_.max_range);
  if (length <= 0) return;
  const octomap::point3d origin = to_octomap(T_map_cam.translation());
  const octomap::point3d end = to_octomap(T_map_cam * (p_cam * (length / range)));
  octomap::OcTreeKey origin_key, end_key;
  // computeRayKeys() would print a warning for ends out of bounds.
  if (!tree_->coordToKeyChecked(origin, origin_key) || !tree_->coordToKeyChecked(end, end_key)) return;
  if (!ray_ends_.insert(end_key).second) return;
  tree_->computeRayKeys(origin, end, ray_);
  free_.insert(ray_.begin(), ray_.end());
  ++stats_->rays;
}

void SegmentInserter::update_tree() {
  for (const octomap::OcTreeKey& key : free_)
    if (seen_until_.find(key) == seen_until_.end()) updates_.add(key, tree_->getProbMissLog());
  for (auto it = seen_until_.begin(); it != seen_until_.end();) {
    updates_.add(it->first, tree_->getProbHitLog());
    it = it->second > batch_ ? std::next(it) : seen_until_.erase(it);
  }
  // Keeping inner nodes and merging on the way would take half as long again.
  updates_.apply(tree_);
}

}  // namespace edgevo
