// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_updates.h"

#include <algorithm>

namespace edgevo {
namespace {

constexpr int kLevels = 16;  // of an OcTree, below its root

// The bits of a coordinate, three places apart.
uint64_t spread(uint16_t coordinate) {
  uint64_t bits = coordinate;
  bits = (bits | bits << 16) & 0x0000FF0000FF;
  bits = (bits | bits << 8) & 0x00F00F00F00F;
  bits = (bits | bits << 4) & 0x0C30C30C30C3;
  return (bits | bits << 2) & 0x249249249249;
}

uint64_t morton_code(const octomap::OcTreeKey& key) {
  return spread(key[0]) | spread(key[1]) << 1 | spread(key[2]) << 2;
}

// Levels below the root that two voxels share.
int shared_levels(uint64_t a, uint64_t b) {
  return a == b ? kLevels : (__builtin_clzll(a ^ b) - (64 - 3 * kLevels)) / 3;
}

// The way from the root to the newest voxel.
class Path {
 public:
  Path(octomap::OcTree* tree, uint64_t code) : tree_(tree), code_(code) { nodes_[0] = tree->getRoot(); }

  void update(uint64_t code, float change) {
    depth_ = std::min(depth_, shared_levels(code, code_));
    code_ = code;
    bool is_new = false;
    for (; depth_ < kLevels; ++depth_) {
      octomap::OcTreeNode* node = nodes_[size_t(depth_)];
      const unsigned child = unsigned(code >> 3 * (kLevels - 1 - depth_)) & 7;
      if (!is_new && !tree_->nodeHasChildren(node)) {  // its children are equal and were merged
        if (is_at_limit(*node, change)) return;
        tree_->expandNode(node);
      } else if (is_new || !tree_->nodeChildExists(node, child)) {
        tree_->createNodeChild(node, child);
        is_new = true;
      }
      nodes_[size_t(depth_) + 1] = tree_->getNodeChild(node, child);
    }
    tree_->updateNodeLogOdds(nodes_[kLevels], change);
  }

 private:
  bool is_at_limit(const octomap::OcTreeNode& node, float change) const {
    return change >= 0 ? node.getLogOdds() >= tree_->getClampingThresMaxLog()
                       : node.getLogOdds() <= tree_->getClampingThresMinLog();
  }

  octomap::OcTree* tree_;
  std::array<octomap::OcTreeNode*, kLevels + 1> nodes_{};
  uint64_t code_;
  int depth_ = 0;  // nodes_ is filled down to here
};

}  // namespace

void VoxelUpdates::add(const octomap::OcTreeKey& key, float change) {
  updates_.push_back({morton_code(key), key, change});
}

void VoxelUpdates::apply(octomap::OcTree* tree) {
  std::sort(updates_.begin(), updates_.end(),
            [](const Update& a, const Update& b) { return a.order < b.order; });
  auto next = updates_.begin();
  // Only the tree itself makes a root.
  if (next != updates_.end() && !tree->getRoot()) {
    tree->updateNode(next->key, next->change, /*lazy_eval=*/true);
    ++next;
  }
  if (next != updates_.end()) {
    Path path(tree, next->order);
    for (; next != updates_.end(); ++next) path.update(next->order, next->change);
  }
  updates_.clear();
}

}  // namespace edgevo
