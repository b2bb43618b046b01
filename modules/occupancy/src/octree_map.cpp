// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/octree_map.h"

#include <octomap/OcTree.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "edgevo/core/output_file.h"
#include "edgevo/core/thread_clock.h"
#include "map_lengths.h"
#include "octree_file.h"
#include "segment_inserter.h"

namespace edgevo {
namespace {

using octomap::OcTree;

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

// Merges equal children whenever the tree has grown to twice its size: memory stays near that of the finished
// map, and all the passes over the tree together cost no more than two over the finished one, however long
// the run.
void merge_when_doubled(OcTree* tree, size_t* size_after_merging) {
  constexpr size_t kSmall = 200000;  // nodes: a few MB, not worth a pass
  if (tree->size() < std::max(kSmall, 2 * *size_after_merging)) return;
  tree->prune();
  *size_after_merging = tree->size();
}

void insert_segment(const Run& run, const Keyframes& keyframes, const InsertionLimits& limits, OcTree* tree,
                    OctreeStats* stats, const OnKeyframeMapped& on_keyframe) {
  const SE3 T_map = T_map_world(run);
  SegmentInserter inserter(run.pinhole, limits, tree, stats);
  for (const KeyframeRecord* keyframe : keyframes) inserter.note(*keyframe, T_map * keyframe->T_world_cam);
  size_t size_after_merging = 0;
  for (const KeyframeRecord* keyframe : keyframes) {
    const double start = thread_cpu_ms();
    inserter.insert(*keyframe, T_map * keyframe->T_world_cam);
    merge_when_doubled(tree, &size_after_merging);
    stats->batch_ms.push_back(thread_cpu_ms() - start);
    if (on_keyframe) on_keyframe(stats->batches);
  }
}

void count_voxels(const OcTree& tree, OctreeStats* stats) {
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    const int levels = int(tree.getTreeDepth()) - int(leaf.getDepth());  // above the finest
    (tree.isNodeOccupied(*leaf) ? stats->occupied_voxels : stats->free_voxels) += int64_t{1} << (3 * levels);
  }
}

}  // namespace

OctreeMap::OctreeMap(const Run& run, const OccupancyParams& params, const OnKeyframeMapped& on_keyframe) {
  params.check();
  stats_.points = count_points(run, params.points);
  const MapLengths lengths = map_lengths(run, params);
  stats_.median_depth = lengths.median_depth;
  stats_.resolution = lengths.resolution;
  stats_.max_range = lengths.max_range;
  const InsertionLimits limits{params.points, stats_.max_range, params.carve_max_relative_sigma,
                               params.carve_neighbours};

  tree_ = empty_tree(stats_.resolution, params);
  for (const auto& [segment, keyframes] : keyframes_by_segment(run)) {
    auto own = empty_tree(stats_.resolution, params);
    insert_segment(run, keyframes, limits, own.get(), &stats_, on_keyframe);
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
