#include "edgevo/occupancy/octree_map.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/thread_clock.h"
#include "octree_file.h"
#include "segment_inserter.h"

namespace edgevo {
namespace {

using octomap::OcTree;

// Unit of the run: voxels of an empty map, of which nothing tells a size.
constexpr double kResolutionWithoutPoints = 0.1;

double median_depth(const Run& run, const PointFilter& filter) {
  std::vector<double> depths;
  for (const KeyframeRecord& keyframe : run.keyframes)
    for (const EdgePoint& p : keyframe.points)
      if (filter.keeps(p)) depths.push_back(1.0 / double(p.idepth));
  return median(std::move(depths));
}

// Two significant digits, so that "auto" gives a length that one can read and type again.
double round_to_two_digits(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::round(x / unit) * unit;
}

double length_or_share(double given, double share, double median, double without_points) {
  if (given > 0) return given;
  return median > 0 ? round_to_two_digits(share * median) : without_points;
}

std::unique_ptr<OcTree> empty_tree(double resolution, const OccupancyParams& params) {
  auto tree = std::make_unique<OcTree>(resolution);
  tree->setProbHit(params.prob_hit);
  tree->setProbMiss(params.prob_miss);
  return tree;
}

// Joins a segment's map into `total`: occupied in any wins, else free in any.
void join_segment(OcTree* segment, OcTree* total) {
  segment->expand();  // so that each leaf is one voxel with one key
  for (auto leaf = segment->begin_leafs(), end = segment->end_leafs(); leaf != end; ++leaf) {
    const octomap::OcTreeNode* there = total->search(leaf.getKey());
    float value = leaf->getLogOdds();
    if (there) {
      const float other = there->getLogOdds();
      const bool any_occupied = segment->isNodeOccupied(*leaf) || total->isNodeOccupied(there);
      value = any_occupied ? std::max(value, other) : std::min(value, other);
    }
    total->setNodeValue(leaf.getKey(), value, /*lazy_eval=*/true);
  }
}

using Keyframes = std::vector<const KeyframeRecord*>;

std::map<int, Keyframes> keyframes_by_segment(const Run& run) {
  std::map<int, Keyframes> segments;
  for (const KeyframeRecord& keyframe : run.keyframes)
    if (keyframe.T_world_cam.is_finite()) segments[keyframe.segment].push_back(&keyframe);
  return segments;
}

// Merges equal children whenever the tree has grown to twice its size: memory stays near that of the finished map, and all the passes
// over the tree together cost no more than two over the finished one, however long the run.
void merge_when_doubled(OcTree* tree, size_t* size_after_merging) {
  constexpr size_t kSmall = 200000;  // nodes: a few MB, not worth a pass
  if (tree->size() < std::max(kSmall, 2 * *size_after_merging)) return;
  tree->prune();
  *size_after_merging = tree->size();
}

void insert_segment(const Run& run, const Keyframes& keyframes, const InsertionLimits& limits, OcTree* tree,
                    OctreeStats* stats) {
  const SE3 T_map = T_map_world(run);
  SegmentInserter inserter(run.pinhole, limits, tree, stats);
  for (const KeyframeRecord* keyframe : keyframes) inserter.note_points(*keyframe, T_map * keyframe->T_world_cam);
  size_t size_after_merging = 0;
  for (const KeyframeRecord* keyframe : keyframes) {
    const double start = thread_cpu_ms();
    inserter.insert(*keyframe, T_map * keyframe->T_world_cam);
    merge_when_doubled(tree, &size_after_merging);
    stats->batch_ms.push_back(thread_cpu_ms() - start);
  }
}

void count_voxels(const OcTree& tree, OctreeStats* stats) {
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    const int levels = int(tree.getTreeDepth()) - int(leaf.getDepth());  // above the finest
    (tree.isNodeOccupied(*leaf) ? stats->occupied_voxels : stats->free_voxels) += int64_t{1} << (3 * levels);
  }
}

}  // namespace

OctreeMap::OctreeMap(const Run& run, const OccupancyParams& params) {
  params.check();
  stats_.points = count_points(run, params.points);
  stats_.median_depth = median_depth(run, params.points);
  stats_.resolution = length_or_share(params.given_resolution(), params.resolution_share, stats_.median_depth,
                                      kResolutionWithoutPoints);
  stats_.max_range =
      length_or_share(params.given_max_range(), params.max_range_share, stats_.median_depth, 0);
  const InsertionLimits limits{params.points, stats_.max_range, params.carve_max_relative_sigma,
                               params.carve_stop_sigmas, params.carve_neighbours, params.carve_neighbour_share};

  tree_ = empty_tree(stats_.resolution, params);
  for (const auto& [segment, keyframes] : keyframes_by_segment(run)) {
    auto own = empty_tree(stats_.resolution, params);
    insert_segment(run, keyframes, limits, own.get(), &stats_);
    if (tree_->size() == 0)
      tree_ = std::move(own);
    else
      join_segment(own.get(), tree_.get());
  }
  tree_->updateInnerOccupancy();
  tree_->prune();
  count_voxels(*tree_, &stats_);
  comments_ = octree_comments(run);
}

OctreeMap::~OctreeMap() = default;
OctreeMap::OctreeMap(OctreeMap&&) noexcept = default;
OctreeMap& OctreeMap::operator=(OctreeMap&&) noexcept = default;

void OctreeMap::write_bt(const std::string& path) const {
  // Occupied and free children merge only after their probabilities are gone: do that in a copy.
  OcTree copy(*tree_);
  copy.toMaxLikelihood();
  copy.prune();
  std::ostringstream nodes;
  if (copy.getRoot()) copy.writeBinaryNode(nodes, copy.getRoot());
  write_file(path, octree_header(kBtFirstLine, comments_, copy) + nodes.str());
}

void OctreeMap::write_ot(const std::string& path) const {
  std::ostringstream nodes;
  tree_->writeData(nodes);
  write_file(path, octree_header(kOtFirstLine, comments_, *tree_) + nodes.str());
}

}  // namespace edgevo
