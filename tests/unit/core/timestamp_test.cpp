// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/timestamp.h"

#include <gtest/gtest.h>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

int64_t ticks_of(const char* text) {
  Timestamp t;
  return parse_seconds(text, &t) ? t.ticks : INT64_MIN;
}

bool is_refused(const char* text) { return ticks_of(text) == INT64_MIN; }

TEST(Timestamp, TextAndBackIsExact) {
  Random random(1);
  for (int trial = 0; trial < 10000; ++trial) {
    const Timestamp t{int64_t(random.next() >> (1 + random.below(60))) - (1LL << 40)};
    Timestamp back;
    ASSERT_TRUE(parse_seconds(to_string(t), &back)) << to_string(t);
    EXPECT_EQ(back.ticks, t.ticks);
  }
}

TEST(Timestamp, WritesSevenDecimals) {
  EXPECT_EQ(to_string(Timestamp{13050311021753040}), "1305031102.1753040");
  EXPECT_EQ(to_string(Timestamp{1}), "0.0000001");
  EXPECT_EQ(to_string(Timestamp{-15'000'000}), "-1.5000000");
  EXPECT_EQ(to_string(Timestamp{}), "0.0000000");
}

TEST(Timestamp, ReadsWhatDatasetsWrite) {
  EXPECT_EQ(ticks_of("1305031102.175304"), 13050311021753040);  // TUM
  EXPECT_EQ(ticks_of("1.036224e-01"), 1036224);                 // KITTI
  EXPECT_EQ(ticks_of("0.000000e+00"), 0);
  EXPECT_EQ(ticks_of("1403636579.763555584"), 14036365797635556);  // EuRoC's nanoseconds round to the tick
  EXPECT_EQ(ticks_of("12"), 120'000'000);
  EXPECT_EQ(ticks_of(".5"), 5'000'000);
  EXPECT_EQ(ticks_of("-0.25"), -2'500'000);
}

TEST(Timestamp, TheEighthDecimalRounds) {
  EXPECT_EQ(ticks_of("0.00000004"), 0);
  EXPECT_EQ(ticks_of("0.00000005"), 1);
  EXPECT_EQ(ticks_of("0.99999999"), 10'000'000);
}

TEST(Timestamp, RefusesTextThatIsNotANumber) {
  for (const char* text : {"", "-", ".", "1.2.3", "12s", " 1", "1 ", "nan", "inf", "1e", "1e99", "--1", "+1",
                           "0x10", "999999999999999999999", "1,5"})
    EXPECT_TRUE(is_refused(text)) << text;
}

TEST(Timestamp, FromSecondsAndNanosecondsRoundToTheNearestTick) {
  EXPECT_EQ(Timestamp::from_seconds(0.00000016).ticks, 2);
  EXPECT_EQ(Timestamp::from_seconds(-0.00000016).ticks, -2);
  EXPECT_EQ(Timestamp::from_nanoseconds(149).ticks, 1);
  EXPECT_EQ(Timestamp::from_nanoseconds(150).ticks, 2);
  EXPECT_EQ(Timestamp::from_nanoseconds(-150).ticks, -2);
  EXPECT_EQ(Timestamp::from_nanoseconds(1403636579763555584).ticks, 14036365797635556);
}

TEST(Timestamp, OrderAndDifference) {
  const Timestamp a{10'000'000}, b{25'000'000};
  EXPECT_TRUE(a < b && a <= b && a <= a && a != b && !(b < a));
  EXPECT_DOUBLE_EQ(seconds_between(a, b), 1.5);
  EXPECT_DOUBLE_EQ(seconds_between(b, a), -1.5);
  EXPECT_DOUBLE_EQ(b.seconds(), 2.5);
}

}  // namespace
}  // namespace edgevo
