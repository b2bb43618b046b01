// SPDX-License-Identifier: BSD-3-Clause
// The feed on a simulated clock that only advances with sleep and work, so that every time is exact on any
// machine.
#include "edgevo/datasets/live_feed.h"

#include <gmock/gmock.h>

#include <atomic>

#include "edgevo/core/error.h"
#include "support/wait.h"

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TestClock : public FeedClock {
 public:
  double now_s() const override { return now_s_; }
  void sleep_s(double seconds) override { now_s_ = now_s_ + seconds; }

 private:
  std::atomic<double> now_s_{1000};
};

// Frames 0, 1, ... a quarter of a second apart; then the end, or an error.
class TestSource : public ImageSource {
 public:
  explicit TestSource(int frames, bool live = false, bool breaks = false)
      : frames_(frames), live_(live), breaks_(breaks) {}
  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return frames_; }
  std::string kind() const override { return "test"; }
  bool is_live() const override { return live_; }
  std::optional<Frame> next() override {
    if (given_ == frames_) {
      exhausted = true;
      if (breaks_) throw InputError("test", "is broken", "");
      return std::nullopt;
    }
    Frame frame;
    frame.index = given_;
    frame.time = Timestamp::from_seconds(50 + 0.25 * given_);
    frame.image = {2, 1, {uint8_t(given_), 0}};
    ++given_;
    return frame;
  }
  int given() const { return given_; }
  std::atomic<bool> exhausted{false};

 private:
  Camera camera_;
  std::atomic<int> given_{0};
  int frames_;
  bool live_, breaks_;
};

bool never() { return false; }

struct Delivered {
  std::vector<int> index, dropped;
  std::vector<double> due_s, delivered_s;  // after the first frame was due
};

// Takes all frames, working `work_s` on each.
Delivered take_all(LiveFeed& feed, TestClock& clock, double work_s) {
  Delivered delivered;
  double begin = 0;
  while (const auto fed = feed.next(never)) {
    if (delivered.index.empty()) begin = fed->due_s;
    EXPECT_EQ(fed->frame.image.pixels[0], fed->frame.index);
    delivered.index.push_back(fed->frame.index);
    delivered.due_s.push_back(fed->due_s - begin);
    delivered.delivered_s.push_back(fed->delivered_s - begin);
    for (const Frame& frame : fed->dropped) delivered.dropped.push_back(frame.index);
    clock.sleep_s(work_s);
  }
  return delivered;
}

MATCHER_P(Nearly, values, "") {
  if (arg.size() != values.size()) return false;
  for (size_t i = 0; i < arg.size(); ++i)
    if (std::abs(arg[i] - values[i]) > 1e-6) return false;
  return true;
}
using Seconds = std::vector<double>;

TEST(LiveFeed, DeliversEachFrameWhenItIsDue) {
  const auto clock = std::make_shared<TestClock>();
  TestSource source(4);
  LiveFeed feed(source, parse_pace("10"), clock);
  const Delivered delivered = take_all(feed, *clock, 0.03);
  EXPECT_THAT(delivered.index, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(delivered.due_s, Nearly(Seconds{0, 0.1, 0.2, 0.3}));
  EXPECT_THAT(delivered.delivered_s, Nearly(delivered.due_s));
}

TEST(LiveFeed, FollowsTheTimesOfTheSource) {
  const auto clock = std::make_shared<TestClock>();
  TestSource source(3);
  LiveFeed feed(source, parse_pace("2x"), clock);
  EXPECT_THAT(take_all(feed, *clock, 0).delivered_s, Nearly(Seconds{0, 0.125, 0.25}));
}

TEST(LiveFeed, AFrameOfARecordingIsLateRatherThanDropped) {
  const auto clock = std::make_shared<TestClock>();
  TestSource source(30);
  LiveFeed feed(source, parse_pace("10"), clock);
  const Delivered delivered = take_all(feed, *clock, 0.15);
  EXPECT_EQ(delivered.index.size(), 30u);
  EXPECT_TRUE(delivered.dropped.empty());
  for (size_t i = 0; i < 30; ++i)
    EXPECT_NEAR(delivered.due_s[i], 0.1 * double(i), 1e-6);  // work does not shift the due times
  for (size_t i = 0; i < 30; ++i) EXPECT_NEAR(delivered.delivered_s[i], 0.15 * double(i), 1e-6);
}

TEST(LiveFeed, WithoutAPaceAFrameIsDueWhenRequested) {
  const auto clock = std::make_shared<TestClock>();
  TestSource source(3);
  LiveFeed feed(source, Pace(), clock);
  const Delivered delivered = take_all(feed, *clock, 0.15);
  EXPECT_THAT(delivered.due_s, Nearly(Seconds{0, 0.15, 0.3}));
  EXPECT_THAT(delivered.delivered_s, Nearly(delivered.due_s));
}

TEST(LiveFeed, ReadsAFewFramesAhead) {
  TestSource source(100);
  LiveFeed feed(source, parse_pace("10"), std::make_shared<TestClock>());
  // The last of these waits for room.
  ASSERT_TRUE(test::wait_until([&] { return source.given() == int(LiveFeed::kReadAhead) + 1; }));
  EXPECT_EQ(feed.next(never)->frame.index, 0);
  EXPECT_TRUE(test::wait_until([&] { return source.given() == int(LiveFeed::kReadAhead) + 2; }));
}

TEST(LiveFeed, ALiveCameraDropsAndReportsTheOldest) {
  const auto clock = std::make_shared<TestClock>();
  constexpr int kFrames = int(LiveFeed::kMaxWaiting) + 5;
  TestSource source(kFrames, true);
  LiveFeed feed(source, Pace(), clock);
  // All frames arrived while none was fetched.
  ASSERT_TRUE(test::wait_until([&] { return source.exhausted.load(); }));
  clock->sleep_s(0.4);
  const auto first = feed.next(never);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->frame.index, 5);
  EXPECT_NEAR(first->delivered_s - first->due_s, 0.4, 1e-6);  // it has waited since it came in
  ASSERT_EQ(first->dropped.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(first->dropped[size_t(i)].index, i);
  EXPECT_EQ(first->dropped[2].time, Timestamp::from_seconds(50.5));
  const Delivered rest = take_all(feed, *clock, 0);
  EXPECT_EQ(rest.index.size(), LiveFeed::kMaxWaiting - 1);
  EXPECT_TRUE(rest.dropped.empty());
}

TEST(LiveFeed, ALiveCameraPacesItself) {
  TestSource source(3, true);
  EXPECT_THROW(LiveFeed(source, parse_pace("30"), std::make_shared<TestClock>()), InputError);
}

TEST(LiveFeed, AnExceptionOfTheSourceComesAfterTheFramesBefore) {
  const auto clock = std::make_shared<TestClock>();
  TestSource source(3, false, true);
  LiveFeed feed(source, parse_pace("30"), clock);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(feed.next(never)->frame.index, i);
  EXPECT_THROW(feed.next(never), InputError);
  EXPECT_FALSE(feed.next(never));
}

TEST(LiveFeed, StopsWhileItWaitsForAFrameThatIsNotDue) {
  const auto clock = std::make_shared<TestClock>();
  TestSource source(3);
  LiveFeed feed(source, parse_pace("0.001"), clock);
  ASSERT_TRUE(feed.next(never));
  const double begin = clock->now_s();
  EXPECT_FALSE(feed.next([&] { return clock->now_s() > begin + 1; }));
  EXPECT_LT(clock->now_s(), begin + 1.2);
}

// Its thread ends with it, even with unfetched frames and while waiting for room for more.
TEST(LiveFeed, CanBeDestroyedWhileFramesWait) {
  const int threads = test::threads_of_process();
  TestSource source(100);
  {
    const LiveFeed feed(source, Pace());
    EXPECT_TRUE(test::wait_until([&] { return source.given() == int(LiveFeed::kReadAhead) + 1; }));
    EXPECT_GT(test::threads_of_process(), threads);
  }
  EXPECT_TRUE(test::have_ended_down_to(threads));
  EXPECT_EQ(source.given(), int(LiveFeed::kReadAhead) + 1) << "it read on after it was gone";
}

}  // namespace
}  // namespace edgevo
