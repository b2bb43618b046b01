// SPDX-License-Identifier: BSD-3-Clause
// Tracking status where images fail: which frames are LOST, which are not, and where tracking resumes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "edgevo/odometry/odometry.h"
#include "edgevo/simulation/relit_source.h"
#include "edgevo/simulation/rendered_source.h"
#include "rendered_sequences.h"

namespace edgevo::test {
namespace {

constexpr int kFrames = 70, kBegin = 40;

// The first frames over the desk.
const std::vector<Frame>& desk() {
  static const std::vector<Frame> frames = part_of(desk_sequence(), 0, kFrames).clip->frames;
  return frames;
}

// Renumbers the frames and spaces their times evenly.
std::vector<Frame> in_order(std::vector<Frame> frames) {
  for (size_t i = 0; i < frames.size(); ++i) {
    frames[i].index = int(i);
    frames[i].time = Timestamp::from_seconds(double(i) / 30);
  }
  return frames;
}

// The camera stands still in the dark for `dark` frames before frame kBegin.
std::vector<Frame> with_blackout(int dark) {
  std::vector<Frame> frames(desk().begin(), desk().begin() + kBegin);
  Frame black = desk()[kBegin];
  std::fill(black.image.pixels.begin(), black.image.pixels.end(), uint8_t(0));
  frames.insert(frames.end(), size_t(dark), black);
  frames.insert(frames.end(), desk().begin() + kBegin, desk().end());
  return in_order(std::move(frames));
}

template <class Change>
std::vector<Frame> changed(const Change& change, int begin = 0) {
  std::vector<Frame> frames = in_order(desk());
  for (size_t i = size_t(begin); i < frames.size(); ++i) change(int(i), &frames[i].image);
  return frames;
}

Run run_over(const std::vector<Frame>& frames, const OdometryParams& params = {}) {
  static const Camera camera = load_scene("desk").camera;
  Odometry odometry(camera, params, OdometryOptions());
  for (const Frame& frame : frames) odometry.process(frame);
  return odometry.finish();
}

int count(const Run& run, TrackingState state) {
  return int(std::count_if(run.frames.begin(), run.frames.end(),
                           [&](const FrameRecord& f) { return f.state == state; }));
}

// Exactly the dark frames are LOST, each frame has its row, and tracking relocalises in the old map.
TEST(TrackingStatus, BlackoutsOfOneTenAndSixtyFrames) {
  for (const int dark : {1, 10, 60}) {
    SCOPED_TRACE(std::to_string(dark) + " black frames");
    const auto run = run_over(with_blackout(dark));
    ASSERT_EQ(run.frames.size(), size_t(kFrames + dark));
    for (const FrameRecord& f : run.frames) {
      const bool is_dark = f.index >= kBegin && f.index < kBegin + dark;
      EXPECT_EQ(f.state == TrackingState::kLost, is_dark) << f.index << " " << f.note;
      EXPECT_EQ(f.T_world_cam.has_value(), !is_dark) << f.index;
      EXPECT_EQ(f.segment, is_dark ? -1 : 0) << f.index;
    }
  }
}

// From frame kBegin on the images show another scene, a corridor: the track over the desk ends there.
TEST(TrackingStatus, AnotherSceneIsLostWithinThreeFrames) {
  constexpr int kCut = 12;
  std::vector<Frame> frames(desk().begin(), desk().begin() + kBegin);
  Scene corridor = load_scene("corridor");
  corridor.camera = load_scene("desk").camera;
  RenderedSource source(std::make_shared<SceneRenderer>(corridor), 100, 100 + kCut);
  while (std::optional<Frame> frame = source.next()) frames.push_back(std::move(*frame));
  const auto run = run_over(in_order(std::move(frames)));
  ASSERT_EQ(run.frames.size(), size_t(kBegin + kCut));
  for (const FrameRecord& f : run.frames) {
    if (f.index < kBegin) {
      EXPECT_EQ(f.segment, 0) << f.index;
    } else if (f.index >= kBegin + 3) {
      EXPECT_NE(f.segment, 0) << f.index << " " << f.evidence.inlier_share;
    }
  }
}

// A saturated disc over a fifth of the image wanders about; nothing is lost.
TEST(TrackingStatus, GlareOverAFifthOfTheImageIsNoLoss) {
  const auto run = run_over(changed([](int i, GrayImage* image) {
    const double cx = image->width * (0.5 + 0.4 * std::sin(0.13 * i)),
                 cy = image->height * (0.4 + 0.3 * std::sin(0.07 * i));
    const double radius = std::sqrt(0.2 * image->width * image->height / M_PI);
    for (int y = 0; y < image->height; ++y)
      for (int x = 0; x < image->width; ++x) {
        const double beyond = std::hypot(x - cx, y - cy) - radius;
        uint8_t& gray = image->pixels[size_t(y) * image->width + x];
        gray = uint8_t(std::min(255.0, gray + 300 * std::exp(-std::max(0.0, beyond) / (0.12 * radius))));
      }
  }));
  EXPECT_EQ(count(run, TrackingState::kLost), 0);
  EXPECT_GE(count(run, TrackingState::kTracking) + count(run, TrackingState::kDegraded), kFrames - 10);
}

// The automatic exposure swings by a stop to either side every eight frames.
TEST(TrackingStatus, PumpingExposureIsNoLoss) {
  const auto run = run_over(changed([](int i, GrayImage* image) {
    const double gain = std::exp2(std::sin(2 * M_PI * i / 8));
    for (uint8_t& gray : image->pixels) gray = uint8_t(std::min(255.0, gray * gain));
  }));
  EXPECT_EQ(count(run, TrackingState::kLost), 0);
  EXPECT_GE(count(run, TrackingState::kTracking), kFrames - 10);
}

std::vector<double> gaussian(double sigma) {
  const int reach = int(std::ceil(3 * sigma));
  std::vector<double> weights;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    sum += weights.back();
  }
  for (double& w : weights) w /= sum;
  return weights;
}

// Along rows for `step` 1 and `lines` the height, along columns for `step` the width.
void blur_lines(const std::vector<double>& weights, int length, int lines, int step, int line_step,
                std::vector<uint8_t>* pixels) {
  const int reach = int(weights.size()) / 2;
  std::vector<double> line(size_t(length), 0);
  for (int l = 0; l < lines; ++l) {
    uint8_t* first = pixels->data() + size_t(l) * size_t(line_step);
    for (int i = 0; i < length; ++i) line[size_t(i)] = first[size_t(i) * size_t(step)];
    for (int i = 0; i < length; ++i) {
      double sum = 0;
      for (int k = -reach; k <= reach; ++k)
        sum += weights[size_t(k + reach)] * line[size_t(std::clamp(i + k, 0, length - 1))];
      first[size_t(i) * size_t(step)] = uint8_t(std::lround(sum));
    }
  }
}

// The lens mists over, up to a blur of 5 px, with corners and without: a right motion is believed less and
// less, and never drops at once.
TEST(TrackingStatus, TrustFallsSmoothlyAsWitnessesAreTakenAway) {
  const std::vector<Frame> frames = changed(
      [](int i, GrayImage* image) {
        const auto weights = gaussian(0.3 + 4.7 * (i - 20) / (kFrames - 20));
        blur_lines(weights, image->width, image->height, 1, image->width, &image->pixels);
        blur_lines(weights, image->height, image->width, image->width, 1, &image->pixels);
      },
      20);
  for (const bool with_corners : {true, false}) {
    OdometryParams params;
    params.health.corners = with_corners;
    const auto run = run_over(frames, params);
    double largest_step = 0, least = 1;
    for (size_t i = 1; i < run.frames.size(); ++i) {
      const double before = run.frames[i - 1].p_right, now = run.frames[i].p_right;
      if (std::isnan(before) || std::isnan(now)) continue;
      largest_step = std::max(largest_step, std::abs(now - before)), least = std::min(least, now);
    }
    std::cout << "[ figures  ] corners " << with_corners << ": largest step " << largest_step << ", least "
              << least << std::endl;
    EXPECT_LT(largest_step, 0.05);
    EXPECT_EQ(count(run, TrackingState::kTracking), kFrames);
  }
}

// All lighting effects together at driving speed: the fast corners are lost first, and the bootstrap must not
// wait for them.
TEST(TrackingStatus, ADriveInBadLightStartsWithinTenFrames) {
  constexpr int kStreetFrames = 16;
  RelitSource source(std::make_unique<ClipSource>(part_of(street_sequence(), 0, kStreetFrames).clip),
                     Relight("mixed", 1));
  Odometry odometry(source.camera(), OdometryParams(), OdometryOptions());
  int first_map = kStreetFrames;
  while (std::optional<Frame> frame = source.next())
    if (odometry.process(*frame).T_world_cam_live) first_map = std::min(first_map, frame->index);
  EXPECT_LT(first_map, 10);
  const auto run = odometry.finish();
  EXPECT_TRUE(run.frames.front().T_world_cam);
}

}  // namespace
}  // namespace edgevo::test
