// SPDX-License-Identifier: BSD-3-Clause
#include "state_machine.h"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>
#include <vector>

#include "edgevo/core/angle.h"

namespace edgevo {

const char* name_of(Phase phase) {
  constexpr const char* kNames[] = {"BOOTSTRAPPING", "TRACKING", "SEEKING", "LOST"};
  return kNames[int(phase)];
}
bool operator==(const Transition& a, const Transition& b) { return a.next == b.next && a.action == b.action; }
void PrintTo(const Transition& t, std::ostream* out) {
  *out << name_of(t.next) << " / action " << int(t.action);
}

namespace {

constexpr Phase kPhases[] = {Phase::kBootstrapping, Phase::kTracking, Phase::kSeeking, Phase::kLost};
constexpr Event kEvents[] = {Event::kTracked, Event::kDegraded, Event::kUntracked, Event::kOutOfView,
                             Event::kInView,  Event::kMapMade,  Event::kMapRefused};

// The whole machine: pairs that are not listed change nothing.
const std::vector<std::tuple<Phase, Event, Transition>> kTable{
    {Phase::kBootstrapping, Event::kMapMade, {Phase::kTracking, Action::kNone}},
    {Phase::kTracking, Event::kUntracked, {Phase::kLost, Action::kLose}},
    {Phase::kTracking, Event::kOutOfView, {Phase::kSeeking, Action::kBeginBootstrap}},
    {Phase::kSeeking, Event::kUntracked, {Phase::kLost, Action::kLose}},
    {Phase::kSeeking, Event::kInView, {Phase::kTracking, Action::kDropBootstrap}},
    {Phase::kSeeking, Event::kMapMade, {Phase::kTracking, Action::kNone}},
    {Phase::kSeeking, Event::kMapRefused, {Phase::kBootstrapping, Action::kNone}},
    {Phase::kLost, Event::kTracked, {Phase::kTracking, Action::kRelocalised}},
    {Phase::kLost, Event::kMapMade, {Phase::kTracking, Action::kNone}},
    {Phase::kLost, Event::kMapRefused, {Phase::kBootstrapping, Action::kNone}},
};

TEST(StateMachine, MatchesTheTable) {
  for (const Phase phase : kPhases)
    for (const Event event : kEvents) {
      Transition expected{phase, Action::kNone};
      for (const auto& [from, on, to] : kTable)
        if (from == phase && on == event) expected = to;
      EXPECT_EQ(transition(phase, event), expected) << name_of(phase) << ", event " << int(event);
    }
}

TEST(StateMachine, EveryPhaseIsLeftAndReached) {
  for (const Phase phase : kPhases) {
    bool left = false, reached = phase == Phase::kBootstrapping;
    for (const auto& [from, on, to] : kTable)
      left |= from == phase && to.next != phase, reached |= to.next == phase;
    EXPECT_TRUE(left && reached) << name_of(phase);
  }
}

constexpr int kManyEdges = 5000, kNoEdges = 10;

OdometryState tracking(int tries = 3) {
  OdometryState s(tries, StatusParams());
  s.after(Event::kMapMade, 10);
  return s;
}

TEST(OdometryState, BootstrapsUntilThereIsAMap) {
  OdometryState s(3, StatusParams());
  EXPECT_FALSE(s.tracks(kManyEdges));
  EXPECT_TRUE(s.bootstraps());
  EXPECT_EQ(s.segment(), -1);
  EXPECT_EQ(s.without_pose(0, kNoEdges), TrackingState::kBootstrapping) << "nothing was ever lost";
  EXPECT_EQ(s.when_skipped(), TrackingState::kBootstrapping);
  s.after(Event::kMapMade, 10);
  EXPECT_TRUE(s.tracks(kNoEdges));
  EXPECT_FALSE(s.bootstraps());
  EXPECT_EQ(s.segment(), 0);
}

TEST(OdometryState, AfterALossTheOldMapGetsANumberOfTries) {
  OdometryState s = tracking();
  s.after(Event::kUntracked, 20);
  EXPECT_TRUE(s.bootstraps());
  EXPECT_TRUE(s.has_map());
  EXPECT_FALSE(s.has_pose());
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(s.tracks(kNoEdges)) << "a frame that shows nothing is no try";
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(s.tracks(kManyEdges)) << i;
  EXPECT_FALSE(s.tracks(kManyEdges));
  EXPECT_TRUE(s.bootstraps());
}

TEST(OdometryState, AKnownHeadingGrantsTriesByHowWellItIsKnown) {
  const auto tries = [](double sigma) {
    OdometryState s = tracking();
    s.after(Event::kUntracked, 20);
    int count = 0;
    while (count < 10000 && s.tracks(kManyEdges, sigma)) ++count;
    return count;
  };
  EXPECT_EQ(tries(10), tries(std::numeric_limits<double>::infinity()));
  EXPECT_NEAR(tries(rad(1)), 60, 1);
  EXPECT_GT(tries(rad(0.1)), 9 * tries(rad(1)));
}

TEST(OdometryState, EachLossGrantsNewTries) {
  OdometryState s = tracking(1);
  for (int loss = 0; loss < 3; ++loss) {
    s.after(Event::kUntracked, 20 + 10 * loss);
    EXPECT_TRUE(s.tracks(kManyEdges));
    EXPECT_FALSE(s.tracks(kManyEdges));
    EXPECT_EQ(s.after(Event::kTracked, 25 + 10 * loss), Action::kRelocalised);
  }
  EXPECT_EQ(s.segment(), 0);
}

TEST(OdometryState, FramesWithoutAPoseAreLostOrBootstrapping) {
  OdometryState s = tracking();
  s.after(Event::kUntracked, 20);
  EXPECT_EQ(s.without_pose(20, kManyEdges), TrackingState::kLost) << "the frame of the loss";
  EXPECT_EQ(s.without_pose(21, kManyEdges), TrackingState::kBootstrapping) << "a bootstrap can use it";
  EXPECT_EQ(s.without_pose(21, kNoEdges), TrackingState::kLost);
  EXPECT_EQ(s.when_skipped(), TrackingState::kLost);
}

TEST(OdometryState, LocatedFramesHaveASegmentOfTheirOwnUntilThereIsAMap) {
  OdometryState s(2, {});
  EXPECT_TRUE(s.may_be_located());
  EXPECT_TRUE(s.locate()) << "a segment begins";
  EXPECT_FALSE(s.locate()) << "it goes on";
  EXPECT_EQ(s.segment(), 0);
  EXPECT_FALSE(s.has_map());
  EXPECT_TRUE(s.may_be_located());
  s.after(Event::kMapMade, 10);
  EXPECT_EQ(s.segment(), 1);
  EXPECT_FALSE(s.may_be_located());
}

TEST(OdometryState, ARefusedMapEndsTheOldOneButKeepsItsNumber) {
  OdometryState s = tracking();
  s.after(Event::kOutOfView, 20);
  EXPECT_TRUE(s.tracks(kManyEdges));
  EXPECT_TRUE(s.bootstraps());
  s.after(Event::kMapRefused, 30);
  EXPECT_FALSE(s.has_map());
  EXPECT_EQ(s.segment(), 0);
  s.after(Event::kMapMade, 40);
  EXPECT_EQ(s.segment(), 1);
}

}  // namespace
}  // namespace edgevo
