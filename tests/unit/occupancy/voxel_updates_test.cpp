// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_updates.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

std::string bytes_of(octomap::OcTree* tree) {
  std::ostringstream out;
  tree->updateInnerOccupancy();
  tree->writeData(out);
  return out.str();
}

// Some voxels of a box, each once; many neighbours, some far away.
std::vector<octomap::OcTreeKey> some_voxels(Random* random) {
  std::set<std::array<uint16_t, 3>> chosen;
  for (int i = 0; i < 400; ++i)
    chosen.insert({uint16_t(32768 + random->below(8)), uint16_t(32760 + random->below(16)),
                   uint16_t(32768 + random->below(4))});
  for (int i = 0; i < 20; ++i)
    chosen.insert(
        {uint16_t(random->below(65536)), uint16_t(random->below(65536)), uint16_t(random->below(65536))});
  std::vector<octomap::OcTreeKey> keys;
  for (const auto& k : chosen) keys.emplace_back(k[0], k[1], k[2]);
  return keys;
}

TEST(VoxelUpdates, MakeTheTreeOfSingleUpdates) {
  octomap::OcTree one_by_one(0.1), at_once(0.1);
  Random random(4);
  VoxelUpdates updates;
  for (int batch = 0; batch < 12; ++batch) {
    for (const octomap::OcTreeKey& key : some_voxels(&random)) {
      // Mostly misses, so that voxels reach the limit, children merge and are opened again.
      const float change = random.below(5) == 0 ? one_by_one.getProbHitLog() : one_by_one.getProbMissLog();
      one_by_one.updateNode(key, change, true);
      updates.add(key, change);
    }
    updates.apply(&at_once);
    if (batch % 3 == 2) one_by_one.prune(), at_once.prune();
    ASSERT_EQ(one_by_one.size(), at_once.size()) << batch;
    ASSERT_EQ(bytes_of(&one_by_one), bytes_of(&at_once)) << batch;
  }
}

TEST(VoxelUpdates, WithoutUpdatesLeaveTheTreeEmpty) {
  octomap::OcTree tree(0.1);
  VoxelUpdates().apply(&tree);
  EXPECT_EQ(tree.size(), 0u);
}

}  // namespace
}  // namespace edgevo
