// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/unresolved_scale.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TrustedReference view(int keyframe, int segment = 1) {
  auto reference = std::make_shared<Reference>();
  reference->keyframe_id = keyframe;
  return {keyframe, segment, reference};
}
RelativeScale unlinked() { return {}; }
RelativeScale linked(double ratio, double sigma) {
  RelativeScale unit;
  unit.ratio = ratio;
  unit.sigma = sigma;
  return unit;
}

class UnitAfterADoubt : public ::testing::Test {
 protected:
  const std::vector<TrustedReference> before_{view(7, 0), view(6, 0)};
  UnresolvedScale unit_;
};

TEST_F(UnitAfterADoubt, IsLookedForUntilALaterViewKnowsIt) {
  unit_.note(100, before_, view(20), unlinked());
  ASSERT_TRUE(unit_.is_open());
  EXPECT_EQ(unit_.before().front().reference, before_.front().reference);
  EXPECT_TRUE(unit_.is_due(110, view(21)));
  unit_.note(110, unit_.before(), view(21), linked(1.01, 0.028));
  EXPECT_FALSE(unit_.is_open());
}

TEST_F(UnitAfterADoubt, IsNotLookedForIfTheFirstComparisonKnowsIt) {
  unit_.note(100, before_, view(20), linked(1.01, 0.028));
  EXPECT_FALSE(unit_.is_open());
}

TEST_F(UnitAfterADoubt, IsComparedByAnotherKeyframeOnly) {
  unit_.note(100, before_, view(20), unlinked());
  EXPECT_FALSE(unit_.is_due(200, view(20)));
  EXPECT_TRUE(unit_.is_due(200, view(21)));
}

// A camera that travels on does not come back: the cost of looking grows with the logarithm of the time.
TEST_F(UnitAfterADoubt, IsComparedLessAndLessOften) {
  unit_.note(100, before_, view(20), unlinked());
  int comparisons = 0;
  for (int frame = 101; frame < 1100; ++frame)
    if (unit_.is_due(frame, view(frame))) {
      unit_.note(frame, unit_.before(), view(frame), unlinked());
      ++comparisons;
    }
  EXPECT_GT(comparisons, 8);
  EXPECT_LT(comparisons, 20);
}

// The first link of a young map is often a poor one.
TEST_F(UnitAfterADoubt, IsLookedForFurtherWhileTheLinkIsUncertain) {
  unit_.note(100, before_, view(20), linked(1.1, 0.14));
  EXPECT_TRUE(unit_.is_open());
}

// The unit of a young map moves on.
TEST_F(UnitAfterADoubt, IsComparedUntilItIsWhatIsKnown) {
  unit_.note(100, before_, view(20), linked(0.6, 0.028));
  ASSERT_TRUE(unit_.is_open());
  unit_.note(110, unit_.before(), view(21), linked(1.04, 0.028));
  ASSERT_TRUE(unit_.is_open());
  unit_.note(120, unit_.before(), view(22), linked(0.99, 0.028));
  EXPECT_FALSE(unit_.is_open());
}

// It is no young one.
TEST_F(UnitAfterADoubt, IsThatOfOneMapOnceSomethingLinksIt) {
  unit_.note(100, {view(18), view(17)}, view(20), linked(1.2, 0.08));
  EXPECT_FALSE(unit_.is_open());
}

// A second failure: its map is linked to one that is itself of an unknown unit.
TEST_F(UnitAfterADoubt, IsThatBeforeTheFirstOfSeveralDoubts) {
  unit_.note(100, before_, view(20), unlinked());
  unit_.note(150, {view(25)}, view(30, 2), linked(1.01, 0.028));
  ASSERT_TRUE(unit_.is_open());
  EXPECT_EQ(unit_.before().front().reference, before_.front().reference);
}

}  // namespace
}  // namespace edgevo
