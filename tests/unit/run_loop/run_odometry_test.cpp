// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_loop/run_odometry.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "edgevo/core/bad_frame.h"
#include "edgevo/map/map_log.h"

namespace edgevo {
namespace {

// A hundred blank images, or `breaks_at` of them and then an exception. The images of `bad` are unusable.
class BlankSource : public ImageSource {
 public:
  explicit BlankSource(int breaks_at = -1, std::set<int> bad = {})
      : breaks_at_(breaks_at), bad_(std::move(bad)) {
    camera_.set_pinhole({50, 50, 32, 24, 64, 48});
  }

  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return 100; }
  std::string kind() const override { return "blank"; }
  std::optional<SE3> T_vehicle_cam() const override {
    return SE3(Eigen::Quaterniond::Identity(), {0, 0, 1.5});
  }
  std::optional<Frame> next() override {
    if (next_ == breaks_at_) throw std::runtime_error("the cable");
    if (next_ == 100) return std::nullopt;
    const int index = next_++;
    if (bad_.count(index))
      throw BadFrame(index, Timestamp::from_seconds(0.1 * index),
                     InputError("an image", "is torn", "mend it"));
    return Frame{index, Timestamp::from_seconds(0.1 * index),
                 GrayImage{64, 48, std::vector<uint8_t>(64 * 48, 90)}};
  }

 private:
  Camera camera_;
  int breaks_at_, next_ = 0;
  std::set<int> bad_;
};

bool keep_going(const ProcessedFrame&) { return true; }

TEST(RunOdometry, ProcessesAllFramesOfTheSource) {
  BlankSource source;
  int seen = 0;
  const RunResult result = run_odometry(source, {}, {}, [&](const ProcessedFrame& f) {
    EXPECT_EQ(f.frame.index, seen);
    EXPECT_EQ(f.record.index, seen++);
    return true;
  });
  EXPECT_EQ(seen, 100);
  EXPECT_EQ(result.run.frames.size(), 100u);
  EXPECT_FALSE(result.broken);
  ASSERT_TRUE(result.run.T_vehicle_cam);
  EXPECT_EQ(result.run.T_vehicle_cam->translation().z(), 1.5);
}

TEST(RunOdometry, TheEventOfAFrameIsInTheLogWhenTheFrameIsShown) {
  BlankSource source;
  RunLoopOptions options;
  options.odometry.map_log = std::make_shared<MapLog>();
  MapCursor events(options.odometry.map_log);
  run_odometry(source, {}, options, [&](const ProcessedFrame& f) {
    int announced = -1;
    for (const auto& event : events.read())
      if (const auto* frame = std::get_if<FrameAnchored>(event.get())) announced = frame->frame.index;
    EXPECT_EQ(announced, f.frame.index);
    EXPECT_TRUE(f.view().pyramid);
    return f.frame.index < 5;
  });
}

TEST(RunOdometry, EndsWhenOnFrameReturnsFalse) {
  BlankSource source;
  EXPECT_EQ(run_odometry(source, {}, {}, [](const ProcessedFrame& f) { return f.frame.index < 9; })
                .run.frames.size(),
            10u);
}

TEST(RunOdometry, EndsWhenStopped) {
  BlankSource source;
  RunLoopOptions options;
  options.stop = [polls = 0]() mutable { return polls++ == 7; };
  EXPECT_EQ(run_odometry(source, {}, options, keep_going).run.frames.size(), 7u);
}

TEST(RunOdometry, KeepsFramesBeforeTheSourceFailed) {
  for (const bool realtime : {false, true}) {
    BlankSource source(12);
    RunLoopOptions options;
    options.odometry.realtime = realtime;
    const RunResult result = run_odometry(source, {}, options, keep_going);
    EXPECT_EQ(result.run.frames.size(), 12u);
    EXPECT_EQ(result.run.realtime.has_value(), realtime);
    ASSERT_TRUE(result.broken);
    EXPECT_THROW(std::rethrow_exception(result.broken), std::runtime_error);
  }
}

TEST(RunOdometry, SkipsBadFramesAndReportsThem) {
  for (const bool realtime : {false, true}) {
    BlankSource source(-1, {7, 8, 40});
    RunLoopOptions options;
    options.odometry.realtime = realtime;
    options.on_bad_frame = OnBadFrame::kSkip;
    int without_image = 0;
    const RunResult result = run_odometry(source, {}, options, [&](const ProcessedFrame& f) {
      without_image += f.frame.image.empty();
      return true;
    });
    EXPECT_FALSE(result.broken);
    EXPECT_EQ(without_image, 3);
    EXPECT_EQ(result.skipped, 3);
    EXPECT_EQ(result.first_skipped, "an image: is torn");
    ASSERT_EQ(result.run.frames.size(), 100u);
    EXPECT_EQ(result.run.frames[40].index, 40);
    EXPECT_EQ(result.run.frames[40].note, "left out: an image: is torn");
    EXPECT_EQ(result.run.frames[40].latency_ms.has_value(), false);
    EXPECT_EQ(result.run.frames[41].latency_ms.has_value(), realtime);
  }
}

TEST(RunOdometry, EndsAtABadFrameByDefault) {
  BlankSource source(-1, {12});
  const RunResult result = run_odometry(source, {}, {}, keep_going);
  EXPECT_EQ(result.run.frames.size(), 12u);
  ASSERT_TRUE(result.broken);
  EXPECT_THROW(std::rethrow_exception(result.broken), BadFrame);
}

TEST(RunOdometry, EndsAtABadFirstFrame) {
  BlankSource source(-1, {0});
  RunLoopOptions options;
  options.on_bad_frame = OnBadFrame::kSkip;
  const RunResult result = run_odometry(source, {}, options, keep_going);
  EXPECT_TRUE(result.run.frames.empty());
  EXPECT_TRUE(result.broken);
}

// Times that cannot be used; a source whose first frames have none may still have others.
class TimelessSource : public BlankSource {
 public:
  explicit TimelessSource(int bad_first) : bad_first_(bad_first) {}
  std::optional<Frame> next() override {
    auto frame = BlankSource::next();
    if (frame && frame->index < bad_first_)
      throw BadFrame(frame->index, {}, InputError("a frame", "has no time", "record one"),
                     BadFrame::What::kTime);
    return frame;
  }

 private:
  int bad_first_;
};

TEST(RunOdometry, SkipsFirstFramesWithoutATimeButNotWhereAllAre) {
  RunLoopOptions options;
  options.on_bad_frame = OnBadFrame::kSkip;
  TimelessSource few(3), all(100);
  const RunResult result = run_odometry(few, {}, options, keep_going);
  EXPECT_FALSE(result.broken);
  EXPECT_EQ(result.run.frames.size(), 100u);
  EXPECT_EQ(result.skipped, 3);
  EXPECT_TRUE(run_odometry(all, {}, options, keep_going).broken);
}

}  // namespace
}  // namespace edgevo
