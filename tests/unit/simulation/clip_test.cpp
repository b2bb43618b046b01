// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/clip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace edgevo {
namespace {

// Frames 5, 6, 7, ... of plain images whose gray is their number.
class CountingSource : public ImageSource {
 public:
  explicit CountingSource(int count) : count_(count) { camera_.set_pinhole({10, 10, 4, 3, 8, 6}); }
  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return count_; }
  std::string kind() const override { return "counting"; }
  std::optional<Frame> next() override {
    if (next_ == count_) return std::nullopt;
    const int i = next_++;
    return Frame{5 + i, Timestamp{1000 * i}, GrayImage{8, 6, std::vector<uint8_t>(48, uint8_t(i))}};
  }

 private:
  Camera camera_;
  int count_, next_ = 0;
};

TEST(Clip, PlaysTheSameAgainAndAgain) {
  CountingSource source(4);
  const auto clip = read_clip(source, [](int) { return true; });
  for (int round = 0; round < 2; ++round) {
    ClipSource player(clip);
    EXPECT_EQ(player.size(), 4);
    EXPECT_EQ(player.kind(), "counting");
    EXPECT_EQ(player.camera().pinhole().width, 8);
    EXPECT_EQ(player.times().size(), 4u);
    EXPECT_TRUE(player.skip());
    for (int i = 1; i < 4; ++i) {
      const std::optional<Frame> frame = player.next();
      ASSERT_TRUE(frame.has_value());
      EXPECT_EQ(frame->index, 5 + i);
      EXPECT_EQ(frame->time, Timestamp{1000 * i});
      EXPECT_EQ(frame->image.pixels[0], i);
    }
    EXPECT_FALSE(player.next().has_value());
    EXPECT_FALSE(player.skip());
  }
}

TEST(Clip, BackwardTheTimesGrowToo) {
  CountingSource source(4);
  const auto clip = read_clip(source, [](int) { return true; });
  const auto backward = played_backward(*clip);
  ASSERT_EQ(backward->frames.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(backward->frames[size_t(i)].index, 5 + i);
    EXPECT_EQ(backward->frames[size_t(i)].time, Timestamp{1000 * i});
    EXPECT_EQ(backward->frames[size_t(i)].image.pixels[0], 3 - i);
  }
  EXPECT_EQ(backward->camera.pinhole().width, 8);
}

// A gyro next to the counting source: four samples, one before the first frame.
class TurningSource : public CountingSource {
 public:
  TurningSource() : CountingSource(4) {}
  GyroReadings gyro_readings() const override {
    return [i = 0]() mutable -> std::optional<GyroSample> {
      if (i == 4) return std::nullopt;
      const int n = i++;
      return GyroSample{Timestamp{900 * n - 100}, {0.1 * n, 1, 2}, {0, 9.8, 0}};
    };
  }
};

std::vector<GyroSample> played_gyro(std::shared_ptr<const Clip> clip) {
  std::vector<GyroSample> samples;
  const GyroReadings readings = ClipSource(std::move(clip)).gyro_readings();
  while (const auto sample = readings ? readings() : std::nullopt) samples.push_back(*sample);
  return samples;
}

TEST(Clip, HasTheGyroOfItsSource) {
  TurningSource source;
  const auto clip = read_clip(source, [](int) { return true; });
  for (int round = 0; round < 2; ++round) EXPECT_EQ(played_gyro(clip).size(), 4u);
  EXPECT_EQ(played_gyro(with_gaps(*clip, 3)).size(), 4u);
  const std::vector<GyroSample> backward = played_gyro(played_backward(*clip));
  ASSERT_EQ(backward.size(), 4u);
  for (int n = 0; n < 4; ++n) {
    const GyroSample& sample = backward[size_t(3 - n)];
    EXPECT_EQ(sample.time, Timestamp{3000 - (900 * n - 100)});
    EXPECT_EQ(sample.rate, Eigen::Vector3d(-0.1 * n, -1, -2));
    EXPECT_EQ(sample.acceleration.y(), 9.8);
  }
  CountingSource without(4);
  EXPECT_FALSE(ClipSource(read_clip(without, [](int) { return true; })).gyro_readings());
}

TEST(Clip, WithGapsFramesAreMissingAndTheOthersAreAsBefore) {
  CountingSource source(200);
  const auto clip = read_clip(source, [](int) { return true; });
  const auto left = with_gaps(*clip, 3);
  EXPECT_GT(left->frames.size(), 110u);
  EXPECT_LT(left->frames.size(), 150u);
  EXPECT_EQ(left->frames.front().index, 5);
  int longest = 0;
  for (size_t i = 0; i < left->frames.size(); ++i) {
    const Frame& frame = left->frames[i];
    EXPECT_EQ(frame.time, Timestamp{1000 * (frame.index - 5)});
    EXPECT_EQ(frame.image.pixels[0], frame.index - 5);
    if (i > 0) longest = std::max(longest, frame.index - left->frames[i - 1].index);
  }
  EXPECT_GE(longest, 5);
  const auto indices = [](const Clip& c) {
    std::vector<int> all;
    for (const Frame& frame : c.frames) all.push_back(frame.index);
    return all;
  };
  EXPECT_EQ(indices(*with_gaps(*clip, 3)), indices(*left));
  EXPECT_NE(indices(*with_gaps(*clip, 4)), indices(*left));
}

TEST(Clip, ReadingCanBeEnded) {
  CountingSource source(100);
  const auto clip = read_clip(source, [](int done) { return done < 3; });
  EXPECT_EQ(clip->frames.size(), 3u);
}

}  // namespace
}  // namespace edgevo
