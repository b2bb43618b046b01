// SPDX-License-Identifier: BSD-3-Clause
#include "held_back.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(HeldBack, WithoutKeyframesNoEstimateCounts) { EXPECT_FALSE(HeldBack().allows_estimate()); }

TEST(HeldBack, OnlyWhatSpeaksAgainstByMoreThanChanceRejects) {
  EXPECT_TRUE((HeldBack{0.02, 0.01, 8}).allows_estimate());
  EXPECT_TRUE((HeldBack{-0.025, 0.01, 8}).allows_estimate());
  EXPECT_FALSE((HeldBack{-0.035, 0.01, 8}).allows_estimate());
}

}  // namespace
}  // namespace edgevo
