// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/pace.h"

#include <gmock/gmock.h>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

Timestamp at(double seconds) { return Timestamp::from_seconds(1e9 + seconds); }

TEST(Pace, ARateCountsFramesWhateverTheirTimesSay) {
  const Pace pace = parse_pace("30");
  EXPECT_EQ(pace.due_s(0, at(0), at(0)), 0);
  EXPECT_DOUBLE_EQ(pace.due_s(45, at(0), at(7)), 1.5);
  EXPECT_EQ(describe(pace), "30 frames a second");
  EXPECT_DOUBLE_EQ(parse_pace("12.5").due_s(1, at(0), at(0)), 0.08);
}

TEST(Pace, TimesOfTheSourceAtAnySpeed) {
  EXPECT_NEAR(parse_pace("1x").due_s(3, at(0), at(0.7)), 0.7, 1e-9);
  EXPECT_NEAR(parse_pace("0.5x").due_s(3, at(0), at(0.7)), 1.4, 1e-9);
  EXPECT_NEAR(parse_pace("10x").due_s(3, at(2), at(2.7)), 0.07, 1e-9);
  EXPECT_EQ(describe(parse_pace("1x")), "the source's own times");
  EXPECT_EQ(describe(parse_pace("2x")), "the source's own times, 2 times as fast");
}

TEST(Pace, AnInvalidPaceIsReportedInOneLine) {
  for (const char* text : {"", "x", "0", "0x", "-30", "fast", "30 fps", "1x2", "nan", "infx", "1e9", "1e-9x"})
    try {
      parse_pace(text);
      ADD_FAILURE() << text;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("--pace '" + std::string(text) +
                                      "': is not a pace; give frames a second such as 30"));
    }
}

}  // namespace
}  // namespace edgevo
