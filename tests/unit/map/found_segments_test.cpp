// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/found_segments.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

ConstraintAdded found_in_kept_map(int id, int keyframe) {
  ConstraintAdded added;
  added.id = id;
  added.constraint.kind = ConstraintKind::kPlace;
  added.constraint.from = NodeId::world(), added.constraint.to = NodeId::keyframe(keyframe);
  return added;
}
EpochsPlaced placed_with(int newest_constraint) {
  EpochsPlaced placed;
  placed.newest_constraint = newest_constraint;
  return placed;
}

// A solution that was under way when the keyframe was found is still in the frame of before.
TEST(FoundSegments, AreInTheKeptMapOnceSolvedByWhatFoundThem) {
  FoundSegments found;
  found.apply(KeyframeAdded{7, 70, 2});
  found.apply(found_in_kept_map(4, 7));
  EXPECT_FALSE(found.contains(2));
  found.apply(placed_with(3));
  EXPECT_FALSE(found.contains(2));
  found.apply(placed_with(4));
  EXPECT_TRUE(found.contains(2));
  EXPECT_FALSE(found.contains(1));
  found.apply(ConstraintWithdrawn{4});
  EXPECT_FALSE(found.contains(2));
}

}  // namespace
}  // namespace edgevo
