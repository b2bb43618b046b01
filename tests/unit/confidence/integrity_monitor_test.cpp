// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/integrity_monitor.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

using Integrity = IntegrityMonitor::Integrity;

// A run whose reference changes every fourth frame.
class HealthOfARun : public ::testing::Test {
 protected:
  Integrity frame(bool is_doubtful) {
    if (next_ % 4 == 0) {
      reference_ = std::make_shared<Reference>();
      reference_->keyframe_id = next_ / 4;
    }
    const int index = next_++;
    return watch_.add(index, {index, 0, reference_}, is_doubtful);
  }
  void sure_frames(int n) {
    for (int i = 0; i < n; ++i) EXPECT_EQ(frame(false), Integrity::kNominal);
  }
  int keyframe_before() const {
    return watch_.newest_before() ? watch_.newest_before()->reference->keyframe_id : -1;
  }

  IntegrityMonitor watch_;
  std::shared_ptr<Reference> reference_;
  int next_ = 0;
};

TEST_F(HealthOfARun, WithoutDoubtEveryFrameIsSure) { sure_frames(40); }

TEST_F(HealthOfARun, ReturnsWhenTenFramesInARowAreSure) {
  sure_frames(20);
  EXPECT_EQ(frame(true), Integrity::kInDoubt);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(frame(false), Integrity::kInDoubt);
  EXPECT_EQ(frame(true), Integrity::kInDoubt);
  for (int i = 0; i + 1 < kDoubtReach; ++i) EXPECT_EQ(frame(false), Integrity::kInDoubt);
  EXPECT_EQ(frame(false), Integrity::kRecovered);
  sure_frames(20);
}

// p_right speaks of ten frames: what was seen within them is no measure.
TEST_F(HealthOfARun, WhatCountsIsTheViewBeforeTheTenFramesThatAreDoubted) {
  sure_frames(30);
  EXPECT_EQ(frame(true), Integrity::kInDoubt);  // frame 30
  EXPECT_EQ(keyframe_before(), 5);              // the reference from frame 20 on
  for (int i = 0; i + 1 < kDoubtReach; ++i) EXPECT_EQ(frame(false), Integrity::kInDoubt);
  EXPECT_EQ(frame(false), Integrity::kRecovered);
  EXPECT_EQ(keyframe_before(), 5) << "while the return is evaluated";
  sure_frames(1);
  EXPECT_GT(keyframe_before(), 5);
}

// A doubt can begin before it is noticed, and the camera sees again what it saw somewhat earlier.
TEST_F(HealthOfARun, EarlierViewsAreKeptWithTheLastOne) {
  sure_frames(30);
  EXPECT_EQ(frame(true), Integrity::kInDoubt);
  std::vector<int> keyframes;
  for (const TrustedReference& view : watch_.before()) keyframes.push_back(view.reference->keyframe_id);
  EXPECT_EQ(keyframes, (std::vector<int>{5, 4, 3, 2, 1, 0}));
}

// What was seen before the doubt may have another unit.
TEST_F(HealthOfARun, AfterTheReturnOnlyViewsSinceThenCount) {
  sure_frames(30);
  EXPECT_EQ(frame(true), Integrity::kInDoubt);
  for (int i = 0; i + 1 < kDoubtReach; ++i) EXPECT_EQ(frame(false), Integrity::kInDoubt);
  EXPECT_EQ(frame(false), Integrity::kRecovered);
  sure_frames(1);
  for (const TrustedReference& view : watch_.before()) EXPECT_GE(view.reference->keyframe_id, 10);
}

// The frames up to the loss were sure: the newest view is.
TEST_F(HealthOfARun, AfterALossTheViewBeforeItCounts) {
  sure_frames(30);
  watch_.add_lost();
  next_ = 41;
  EXPECT_EQ(frame(false), Integrity::kInDoubt) << "nothing has checked the motion over the gap";
  EXPECT_EQ(keyframe_before(), 7);
}

TEST_F(HealthOfARun, TheFirstMapIsSureUntilItIsDoubted) {
  watch_.begin_map();
  sure_frames(20);
}

TEST_F(HealthOfARun, ALaterMapIsComparedWithTheOneBefore) {
  sure_frames(30);
  EXPECT_EQ(frame(true), Integrity::kInDoubt);
  watch_.begin_map();
  for (int i = 0; i + 1 < kDoubtReach; ++i) EXPECT_EQ(frame(false), Integrity::kInDoubt);
  EXPECT_EQ(frame(false), Integrity::kRecovered);
  EXPECT_EQ(keyframe_before(), 5);
  sure_frames(20);
}

// The views by which it was joined would say once more what the join said.
TEST_F(HealthOfARun, ALaterMapIsComparedByAnotherViewThanThatOfItsJoin) {
  sure_frames(30);
  watch_.begin_map();
  const auto joined_by = std::make_shared<Reference>();
  joined_by->keyframe_id = 100;
  for (int i = 0; i < 3 * kDoubtReach; ++i)
    EXPECT_EQ(watch_.add(40 + i, {40 + i, 1, joined_by}, false), Integrity::kInDoubt) << i;
  next_ = 404;
  EXPECT_EQ(frame(false), Integrity::kRecovered);
}

}  // namespace
}  // namespace edgevo
