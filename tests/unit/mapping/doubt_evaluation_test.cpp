// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/doubt_evaluation.h"

#include <gtest/gtest.h>

#include "textured_views.h"

namespace edgevo {
namespace {

using test::after_a_step;
using test::texture;
using test::textured_view;

DoubtEvaluation evaluate(const std::vector<TrustedReference>& before, const TrustedReference& now) {
  return evaluate_doubt(test::kTexturedPinhole, before, now, [](const TrustedReference&) { return 1.0; });
}

class AfterADoubt : public ::testing::Test {
 protected:
  TrustedReference before(int keyframe) const { return textured_view(keyframe, 0, texture(1), 10); }
  TrustedReference failure(int keyframe) const { return textured_view(keyframe, 0, texture(2), 10); }
  TrustedReference now(int segment, double depth) const {
    return textured_view(5, segment, after_a_step(texture(1)), depth);
  }
};

TEST_F(AfterADoubt, WithoutAViewBeforeThereIsNothingToCompare) {
  EXPECT_FALSE(evaluate({}, now(0, 10)).unit);
}

// The newest view is of the failure, which was noticed late.
TEST_F(AfterADoubt, AnEarlierViewLinksWhatTheNewestDoesNot) {
  EXPECT_FALSE(evaluate({failure(3)}, now(1, 20)).unit->is_linked());
  const DoubtEvaluation found = evaluate({failure(3), before(2)}, now(1, 20));
  ASSERT_TRUE(found.unit->is_linked());
  EXPECT_NEAR(found.unit->ratio, 0.5, 0.01);
  EXPECT_EQ(found.linked->before.reference->keyframe_id, 2);
  EXPECT_TRUE(found.confirms_map);
}

// A map that nothing links to what was sure stays provisional; a new one is all that there is.
TEST_F(AfterADoubt, OneMapCountsOnceSomethingLinksIt) {
  EXPECT_FALSE(evaluate({failure(3)}, now(0, 20)).confirms_map);
  EXPECT_TRUE(evaluate({before(3)}, now(0, 20)).confirms_map);
  EXPECT_TRUE(evaluate({failure(3)}, now(1, 20)).confirms_map);
}

// What is compared is the unit as it is known by now.
TEST_F(AfterADoubt, TheRatioIsThatOfLengthsInTheWorld) {
  const auto scale_of = [](const TrustedReference& v) { return v.segment == 1 ? 0.5 : 1.0; };
  const DoubtEvaluation found = evaluate_doubt(test::kTexturedPinhole, {before(3)}, now(1, 20), scale_of);
  EXPECT_NEAR(found.unit->ratio, 1, 0.02);
  EXPECT_NEAR(found.linked->link.scale, 0.5, 0.01);
}

}  // namespace
}  // namespace edgevo
