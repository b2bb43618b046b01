// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/reason.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

// The names are in frames.csv, which other programs read.
TEST(KeyframeReason, HasTheNamesOfFramesCsv) {
  EXPECT_EQ(to_string(KeyframeReason::kNone), "");
  EXPECT_EQ(to_string(KeyframeReason::kParallax), "parallax");
  EXPECT_EQ(to_string(KeyframeReason::kRotation), "rotation");
  EXPECT_EQ(to_string(KeyframeReason::kViewLeaves), "view leaves");
  EXPECT_EQ(to_string(KeyframeReason::kFastTurn), "fast turn");
  EXPECT_EQ(to_string(KeyframeReason::kLongSince), "long since");
  EXPECT_EQ(to_string(KeyframeReason::kReturn), "return");
  EXPECT_EQ(to_string(KeyframeReason::kBootstrap), "bootstrap");
}

TEST(KeyframeReason, ParsingInvertsToString) {
  for (int i = 0; i <= int(KeyframeReason::kBootstrap); ++i)
    EXPECT_EQ(parse_keyframe_reason(to_string(KeyframeReason(i))), KeyframeReason(i));
  EXPECT_FALSE(parse_keyframe_reason("fast"));
}

}  // namespace
}  // namespace edgevo
