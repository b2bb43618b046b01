// SPDX-License-Identifier: BSD-3-Clause
#include "time_unit.h"

#include <gtest/gtest.h>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

std::string unit_of(const std::vector<double>& times) { return time_unit_of(times).unit.name; }

TEST(TimeUnit, FollowsFromTheMedianStep) {
  EXPECT_EQ(unit_of({0, 0.033, 0.067, 0.1}), "seconds");
  EXPECT_EQ(unit_of({0, 1, 2, 3}), "seconds");
  EXPECT_EQ(unit_of({0, 33, 67, 100}), "milliseconds");
  EXPECT_EQ(unit_of({0, 33333, 66667, 100000}), "microseconds");
  EXPECT_EQ(unit_of({0, 33333333, 66666667, 100000000}), "nanoseconds");
  EXPECT_EQ(unit_of({0, 0.1, 60, 60.1, 60.2}), "seconds") << "one gap";
}

TEST(TimeUnit, SeesATimeInAnotherUnit) {
  const auto some = other_unit_in({0, 0.1, 0.2, 3e8, 0.4, 0.5});
  ASSERT_TRUE(some);
  EXPECT_EQ(some->index, 3u);
  EXPECT_EQ(some->factor, 1e9);
  const auto rest = other_unit_in({1.6e15, 1.6e15 + 1e5, 1.6e9 + 0.2, 1.6e9 + 0.3});
  ASSERT_TRUE(rest) << "from microseconds to seconds, for good";
  EXPECT_EQ(rest->index, 2u);
  EXPECT_EQ(rest->factor, 1e6);
}

TEST(TimeUnit, APauseIsNoOtherUnit) {
  EXPECT_FALSE(other_unit_in({}));
  EXPECT_FALSE(other_unit_in({0, 0.1, 0.2, 300, 300.1, 300.2}));
  EXPECT_FALSE(other_unit_in({0, 0.1, 0.2, 0.2, 0.1, 0.4, 0.5})) << "times that run backwards";
}

TEST(TimeUnit, AClockThatRunsThroughZeroKeepsItsUnit) {
  for (const double after : {0.0, 1e-6, 0.01}) {
    std::vector<double> times;
    for (int i = -30; i < 30; ++i) times.push_back(i / 30.0 + after);
    EXPECT_FALSE(other_unit_in(times)) << after;
  }
}

TEST(TimeUnit, FollowsFromNumbersSince1970) {
  for (const auto& [factor, name] :
       {std::pair(1.0, "seconds"), {1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    EXPECT_EQ(unit_of({1.7e9 * factor}), name);
    EXPECT_EQ(unit_of({1.7e9 * factor, (1.7e9 + 0.1) * factor, (1.7e9 + 0.2) * factor}), name);
  }
  EXPECT_EQ(unit_of({}), "seconds");
}

// One image each six seconds since 2023, or a clock of 20 days in milliseconds and 167 images a second.
TEST(TimeUnit, ADateThatContradictsTheStepIsADoubt) {
  const UnitOfTimes slow = time_unit_of({1.7e9, 1.7e9 + 6, 1.7e9 + 12, 1.7e9 + 18});
  EXPECT_STREQ(slow.unit.name, "seconds");
  EXPECT_EQ(slow.doubt, "as milliseconds they would be 0.006 s apart; if that is right, give --time-unit ms");
  const UnitOfTimes video = time_unit_of({1.7e9, 1.7e9 + 33, 1.7e9 + 67, 1.7e9 + 100});
  EXPECT_STREQ(video.unit.name, "milliseconds");
  EXPECT_EQ(video.doubt, "as seconds they would be 33 s apart; if that is right, give --time-unit s");
}

TEST(TimeUnit, ARateAboveThatOfAUsualVideoIsADoubt) {
  EXPECT_EQ(time_unit_of({0, 33, 67, 100}).doubt, "");
  EXPECT_EQ(time_unit_of({0, 6, 12, 18}).doubt,
            "these are 166.7 frames a second; as seconds they would be 6 s apart; if that is right, give "
            "--time-unit s");
}

TEST(TimeUnit, ARateThatNoCameraHasIsADoubt) {
  EXPECT_EQ(time_unit_of({0, 1e-6, 2e-6, 3e-6}).doubt,
            "these are 1e+06 frames a second; check the unit of the list");
  EXPECT_EQ(time_unit_of({0, 1e-3, 2e-3, 3e-3}).doubt, "");
}

TEST(TimeUnit, NumbersThatOnlyCountAreADoubt) {
  for (const std::vector<double>& times : {std::vector<double>{0, 1, 2, 3}, {1, 2, 3, 4, 5}}) {
    EXPECT_STREQ(time_unit_of(times).unit.name, "seconds");
    EXPECT_NE(time_unit_of(times).doubt.find("--fps"), std::string::npos);
  }
  EXPECT_EQ(time_unit_of({1.7e9, 1.7e9 + 1, 1.7e9 + 2}).doubt, "");
  EXPECT_EQ(time_unit_of({0, 1, 2.1, 3}).doubt, "");
  EXPECT_EQ(time_unit_of({0, 1}).doubt, "") << "two images of a slow camera";
}

TEST(TimeUnit, TheUserMaySetIt) {
  std::vector<Timestamp> times;
  UnitOfTimes unit;
  size_t bad = 0;
  ASSERT_TRUE(parse_times({"0", "33", "67"}, "s", &times, &unit, &bad));
  EXPECT_EQ(times[2], Timestamp::from_seconds(67));
  EXPECT_THROW(time_unit_given("minutes"), InputError);
}

TEST(TimeUnit, NumbersAreReadExactlyToTheTick) {
  const std::vector<std::string> ns{"1403636579763555584", "1403636579813555456", "1403636579863555584"};
  std::vector<Timestamp> times;
  UnitOfTimes unit;
  size_t bad = 0;
  ASSERT_TRUE(parse_times(ns, "", &times, &unit, &bad));
  EXPECT_EQ(times[0].ticks, 14036365797635556);
  EXPECT_EQ(times[2].ticks - times[0].ticks, 1000000);
  Timestamp t;
  ASSERT_TRUE(parse_time("-5.25", {"milliseconds", "ms", 3}, &t));
  EXPECT_EQ(t.ticks, -52500);
}

TEST(TimeUnit, TheFirstInvalidTextIsNamed) {
  std::vector<Timestamp> times;
  UnitOfTimes unit;
  size_t bad = 0;
  EXPECT_FALSE(parse_times({"0", "33", "noon", "x"}, "", &times, &unit, &bad));
  EXPECT_EQ(bad, 2u);
  for (const char* text : {"", "-", ".", "1.2.3", "1-", "99999999999999999999999999"}) {
    Timestamp t;
    EXPECT_FALSE(parse_time(text, {"milliseconds", "ms", 3}, &t)) << text;
  }
}

}  // namespace
}  // namespace edgevo
