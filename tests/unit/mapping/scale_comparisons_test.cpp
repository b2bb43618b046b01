// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/scale_comparisons.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "textured_views.h"

namespace edgevo {
namespace {

using Integrity = IntegrityMonitor::Integrity;
using test::after_a_step;
using test::texture;
using test::textured_view;

class ComparingScales : public ::testing::TestWithParam<bool> {
 protected:
  void begin(Integrity state, int frame, const TrustedReference& now,
             const std::vector<TrustedReference>& before) {
    scales_.begin(state, frame, now, before, [](const TrustedReference&) { return 1.0; });
  }
  // Waits for an answer, in a thread of its own.
  std::optional<ScaleAnswer> answer(const TrustedReference& now, Integrity state = Integrity::kNominal) {
    for (int i = 0; i < 2000; ++i) {
      if (auto found = scales_.take(state, now)) return found;
      if (!GetParam()) return std::nullopt;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  }
  // Long enough for a comparison that should not have begun.
  bool nothing_comes(const TrustedReference& now) {
    if (GetParam()) std::this_thread::sleep_for(std::chrono::seconds(1));
    return !scales_.take(Integrity::kNominal, now);
  }

  const TrustedReference before_ = textured_view(2, 0, texture(1), 10),
                         unlike_ = textured_view(3, 0, texture(2), 10),
                         now_ = textured_view(5, 0, after_a_step(texture(1)), 20),
                         later_ = textured_view(6, 0, after_a_step(texture(1)), 20);
  ScaleComparisons scales_{test::kTexturedPinhole, GetParam()};
};

TEST_P(ComparingScales, ADoubtEndsWithTheRatioOfTheScales) {
  begin(Integrity::kRecovered, 100, now_, {before_});
  const auto found = answer(now_);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->ends_doubt);
  EXPECT_NEAR(found->found().unit->ratio, 0.5, 0.01);
  EXPECT_TRUE(nothing_comes(now_));
}

TEST_P(ComparingScales, WhatNothingLinksIsComparedAgainWithALaterView) {
  begin(Integrity::kRecovered, 100, unlike_, {before_});
  const auto first = answer(unlike_);
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->found().linked);
  begin(Integrity::kNominal, 110, later_, {});
  const auto second = answer(later_);
  ASSERT_TRUE(second);
  EXPECT_FALSE(second->ends_doubt);
  EXPECT_TRUE(second->found().linked);
}

// An answer that is there and not taken yet may be the one that is looked for.
TEST_P(ComparingScales, NoneBeginsBeforeTheAnswerToTheLastIsTaken) {
  const TrustedReference same_scale = textured_view(6, 0, after_a_step(texture(1)), 10);
  begin(Integrity::kRecovered, 100, unlike_, {before_});
  ASSERT_TRUE(answer(unlike_));
  begin(Integrity::kNominal, 110, same_scale, {});
  if (GetParam()) std::this_thread::sleep_for(std::chrono::seconds(1));
  begin(Integrity::kNominal, 120, same_scale, {});
  EXPECT_TRUE(answer(same_scale));
  EXPECT_TRUE(nothing_comes(same_scale));
}

// What it says of the past stays true.
TEST_P(ComparingScales, AnAnswerThatComesInAnotherDoubtLinksButConfirmsNothing) {
  begin(Integrity::kRecovered, 100, now_, {before_});
  const auto found = answer(now_, Integrity::kInDoubt);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->confirms_map);
  EXPECT_TRUE(found->begins_epoch());
  EXPECT_NEAR(found->found().unit->ratio, 0.5, 0.01);
}

TEST_P(ComparingScales, AnEpochBeginsInAMapThatHasAnotherReferenceSince) {
  begin(Integrity::kRecovered, 100, before_, {before_});
  EXPECT_FALSE(answer(before_)->begins_epoch()) << "the reference is that of before";
  begin(Integrity::kRecovered, 110, textured_view(9, 1, texture(1), 20), {before_});
  EXPECT_FALSE(answer(now_)->begins_epoch()) << "another map";
  begin(Integrity::kRecovered, 120, now_, {before_});
  EXPECT_TRUE(answer(now_)->begins_epoch());
}

INSTANTIATE_TEST_SUITE_P(Thread, ComparingScales, ::testing::Bool(),
                         [](const auto& own) { return own.param ? "OfItsOwn" : "OfTheCaller"; });

}  // namespace
}  // namespace edgevo
