// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/time_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "edgevo/core/clock_shifts.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Timestamp at(double s) { return Timestamp::from_seconds(s); }

// All times checked as a recording is, each with the one after it.
std::vector<CheckedTime> check(const std::vector<Timestamp>& stated) {
  TimeOrder order;
  std::vector<CheckedTime> checked;
  for (size_t i = 0; i < stated.size(); ++i)
    checked.push_back(
        order.check(stated[i], i + 1 < stated.size() ? std::make_optional(stated[i + 1]) : std::nullopt));
  return checked;
}

// Frames whose times have a problem.
std::vector<size_t> bad(const std::vector<CheckedTime>& checked) {
  std::vector<size_t> frames;
  for (size_t i = 0; i < checked.size(); ++i)
    if (!checked[i].problem.empty()) frames.push_back(i);
  return frames;
}

void expect_good_times_increase(const std::vector<CheckedTime>& checked) {
  std::optional<Timestamp> last;
  for (const CheckedTime& j : checked) {
    if (!j.problem.empty()) continue;
    if (last) {
      EXPECT_LT(last->ticks, j.time.ticks);
    }
    last = j.time;
  }
}

TEST(TimeOrder, IncreasingTimesAreKeptToTheTick) {
  const std::vector<Timestamp> stated{at(0), at(0.1), at(0.1000001), at(500), at(1.7e9)};
  const auto checked = check(stated);
  EXPECT_THAT(bad(checked), IsEmpty());
  for (size_t i = 0; i < stated.size(); ++i) EXPECT_EQ(checked[i].time, stated[i]);
}

TEST(TimeOrder, ARepeatedTimeCostsItsFrame) {
  const auto checked = check({at(1), at(2), at(2), at(3)});
  EXPECT_EQ(bad(checked), std::vector<size_t>{2});
  EXPECT_THAT(checked[2].problem,
              HasSubstr("its time 2.0000000 s is not after the frame before (2.0000000 s)"));
  EXPECT_EQ(checked[2].time, at(2)) << "that of the last good frame";
}

TEST(TimeOrder, OfTwoSwappedFramesOneIsSkipped) {
  EXPECT_EQ(bad(check({at(1), at(2), at(4), at(3), at(5)})), std::vector<size_t>{3});
  TimeOrder live;  // without the time of the following frame
  for (const double s : {1, 2, 4}) EXPECT_THAT(live.check(at(s)).problem, IsEmpty());
  EXPECT_THAT(live.check(at(3)).problem, HasSubstr("is not after"));
  EXPECT_THAT(live.check(at(5)).problem, IsEmpty());
}

TEST(TimeOrder, AMissingTimeCostsItsFrame) {
  EXPECT_EQ(bad(check({at(1), kNoTime, at(3)})), std::vector<size_t>{1});
  EXPECT_EQ(bad(check({kNoTime, at(1), at(2)})), std::vector<size_t>{0});
  EXPECT_EQ(bad(check({at(1.7e9), at(0), at(1.7e9 + 1)})), std::vector<size_t>{1});
  EXPECT_EQ(bad(check({at(0), at(1.7e9), at(1.7e9 + 1)})), std::vector<size_t>{0}) << "0 says none";
  EXPECT_THAT(bad(check({at(0), at(0.1), at(0.2)})), IsEmpty()) << "0 is a time";
  for (const int64_t ticks : {INT64_MIN, INT64_MAX, INT64_MIN / 2, INT64_MAX / 2})
    EXPECT_EQ(bad(check({at(1), {ticks}, at(2)})), std::vector<size_t>{1}) << ticks;
}

TEST(TimeOrder, ASingleTimeInTheFutureDoesNotSpoilThoseAfterIt) {
  EXPECT_EQ(bad(check({at(1), at(2), at(1000), at(4), at(5), at(6), at(7)})), std::vector<size_t>{2});
}

TEST(TimeOrder, AfterAClockIsSetBackTimesGoOnFromTheLastGoodOne) {
  std::vector<Timestamp> stated;
  for (int k = 0; k < 5; ++k) stated.push_back(at(100 + 0.1 * k));
  for (int k = 5; k < 12; ++k) stated.push_back(at(70 + 0.1 * k));
  const auto checked = check(stated);
  EXPECT_EQ(bad(checked), (std::vector<size_t>{5, 6, 7}));
  EXPECT_THAT(
      checked[7].problem,
      HasSubstr("the clock was set back by 29.9000000 s 2 frames before: from here on 30.0000000 s are "
                "added to all times"));
  expect_good_times_increase(checked);
  for (size_t k = 7; k < checked.size(); ++k) EXPECT_EQ(checked[k].time, at(100 + 0.1 * double(k))) << k;
  const auto decisions = time_decisions(stated);
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_EQ(decisions[0].subject, "clock");
  EXPECT_EQ(decisions[0].value, "set back at frame 5");
  EXPECT_FALSE(decisions[0].doubt.empty());
}

TEST(ClockShifts, BeginWithTheFirstFrameOfTheOtherClock) {
  std::vector<Timestamp> stated;
  for (int k = 0; k < 5; ++k) stated.push_back(at(100 + 0.1 * k));
  for (int k = 5; k < 9; ++k) stated.push_back(at(70 + 0.1 * k));
  std::vector<int64_t> expected(9, 0);
  std::fill(expected.begin() + 5, expected.end(), at(30).ticks);
  EXPECT_EQ(clock_shifts(stated), expected);
  EXPECT_TRUE(clock_shifts({}).empty());
}

TEST(TimeOrder, APauseInWhichTheViewMayChangeIsSaid) {
  std::vector<Timestamp> steady, paused, slow;
  for (int k = 0; k < 20; ++k) {
    steady.push_back(at(0.1 * k + (k >= 10 ? 0.5 : 0)));
    paused.push_back(at(0.1 * k + (k >= 10 ? 1000 : 0)));
    slow.push_back(at(2 * k + (k >= 10 ? 5 : 0)));
  }
  EXPECT_THAT(time_decisions(steady), IsEmpty()) << "a few frames missing";
  EXPECT_THAT(time_decisions(slow), IsEmpty()) << "a camera of a frame in two seconds";
  const auto decisions = time_decisions(paused);
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_EQ(decisions[0].value, "1; the longest is 1000.1 s, before frame 10");
  EXPECT_FALSE(decisions[0].doubt.empty());
}

TEST(TimeOrder, AListThatRunsBackwardsIsSaid) {
  std::vector<Timestamp> backwards, upset;
  for (int k = 0; k < 20; ++k) {
    backwards.push_back(at(5 - 0.1 * k));
    upset.push_back(at(0.1 * k + (k % 4 == 3 ? -0.2 : 0)));
  }
  const auto decisions = time_decisions(backwards);
  ASSERT_EQ(decisions.size(), 1u);
  EXPECT_EQ(decisions[0].subject, "order");
  EXPECT_FALSE(decisions[0].doubt.empty());
  EXPECT_THAT(time_decisions(upset), IsEmpty()) << "single frames";
}

TEST(TimeOrder, AClockMayBeSetBackAgain) {
  std::vector<Timestamp> stated;
  for (int k = 0; k < 60; ++k) stated.push_back(at(100 + 0.1 * k - 30 * (k / 20)));
  const auto checked = check(stated);
  EXPECT_EQ(bad(checked), (std::vector<size_t>{20, 21, 22, 40, 41, 42}));
  expect_good_times_increase(checked);
  EXPECT_EQ(checked.back().time, at(105.9));
}

TEST(TimeOrder, AClockThatStandsStillCostsAllItsFrames) {
  const auto checked = check({at(1), at(2), at(2), at(2), at(2), at(2), at(3)});
  EXPECT_EQ(bad(checked), (std::vector<size_t>{2, 3, 4, 5}));
}

// Each bad frame has a record, a tick after the one before it.
TEST(TimeOrder, ATimeThatIsUsedUpByBadFramesIsNotAfterThem) {
  TimeOrder order;
  for (const int64_t ticks : {100, 100, 100}) order.check({ticks});
  EXPECT_FALSE(order.check({102}).problem.empty());
  EXPECT_TRUE(order.check({200}).problem.empty());
}

TEST(TimeOrder, MissingTimesAreFilledForStatistics) {
  EXPECT_EQ(fill_missing({kNoTime, at(1), kNoTime, at(3)}),
            (std::vector<Timestamp>{at(1), at(1), at(1), at(3)}));
  EXPECT_EQ(fill_missing({kNoTime}), std::vector<Timestamp>{Timestamp{}});
}

TEST(TimeOrder, RequireThrowsABadFrameThatNamesIt) {
  TimeOrder order;
  EXPECT_EQ(order.require(7, at(2), std::nullopt, "x"), at(2));
  try {
    order.require(8, at(1), std::nullopt, "x.png (frame 8)");
    FAIL() << "accepted";
  } catch (const BadFrame& e) {
    EXPECT_EQ(e.index(), 8);
    EXPECT_EQ(e.time(), at(2));
    EXPECT_EQ(e.what_is_bad(), BadFrame::What::kTime);
    EXPECT_THAT(e.what(), HasSubstr("x.png (frame 8): its time"));
  }
}

}  // namespace
}  // namespace edgevo
