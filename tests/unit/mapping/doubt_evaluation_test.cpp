// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/doubt_evaluation.h"

#include <gtest/gtest.h>

#include <limits>

#include "textured_views.h"

namespace edgevo {
namespace {

using test::after_a_step;
using test::texture;
using test::textured_view;

constexpr double kNotAtAll = std::numeric_limits<double>::infinity();

DoubtEvaluation evaluate(const std::vector<TrustedReference>& before, const TrustedReference& now,
                         double known_to = kNotAtAll) {
  return evaluate_doubt(test::kTexturedPinhole, before, now, known_to, [](int) { return 1.0; });
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
  EXPECT_NEAR(found.ended.scale_ratio, 0.5, 0.01);
}

// Within the same map all that came after the newest one was measured in the other unit.
TEST_F(AfterADoubt, WhatCameAfterTheNewestViewIsSetBack) {
  const DoubtEvaluation found = evaluate({failure(3), before(2)}, now(0, 20));
  EXPECT_NEAR(found.ended.scale_ratio, 0.5, 0.01);
  EXPECT_EQ(found.ended.last_trusted_keyframe, 3);
}

// The unit of a new map is an estimate, which a better one replaces; that of one map is kept unless it is
// shown to be wrong.
TEST_F(AfterADoubt, ASmallDifferenceIsOneOfANewMapOnly) {
  EXPECT_NEAR(evaluate({before(3)}, now(1, 10.4)).ended.scale_ratio, 1 / 1.04, 0.005);
  EXPECT_EQ(evaluate({before(3)}, now(0, 10.4)).ended.scale_ratio, 1);
  EXPECT_EQ(evaluate({before(3)}, now(1, 10.4), 0.001).ended.scale_ratio, 1) << "known better";
}

}  // namespace
}  // namespace edgevo
