// SPDX-License-Identifier: BSD-3-Clause
#include "held_back.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(HeldBack, WithoutKeyframesNothingIsBetter) { EXPECT_FALSE(HeldBack().is_better()); }

TEST(HeldBack, BetterIsWhatExplainsMore) {
  EXPECT_TRUE((HeldBack{0.02, 8}).is_better());
  EXPECT_FALSE((HeldBack{-0.02, 8}).is_better());
}

}  // namespace
}  // namespace edgevo
