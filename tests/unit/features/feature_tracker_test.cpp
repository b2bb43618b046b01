// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/feature_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "corner_tracks.h"

namespace edgevo {
namespace {

constexpr int kWidth = 640, kHeight = 480;
const Pinhole kWallCamera{500, 500, 319.5, 239.5, kWidth, kHeight};

// A texture of soft blobs, which is seen shifted.
class Wall {
 public:
  Wall() {
    std::mt19937 random(3);
    for (int i = 0; i < 700; ++i)
      blobs_.push_back({std::uniform_real_distribution<double>(-200, kWidth + 200)(random),
                        std::uniform_real_distribution<double>(-200, kHeight + 200)(random),
                        std::uniform_real_distribution<double>(-50, 50)(random)});
  }
  std::shared_ptr<const FramePyramid> seen(double shift_x, double shift_y, double gain = 1) {
    std::vector<float> sum(size_t(kWidth) * kHeight, 120.f);
    for (const Blob& b : blobs_) {
      const double cx = b.x + shift_x, cy = b.y + shift_y;
      for (int y = std::max(0, int(cy) - 14); y < std::min(kHeight, int(cy) + 15); ++y)
        for (int x = std::max(0, int(cx) - 14); x < std::min(kWidth, int(cx) + 15); ++x)
          sum[size_t(y) * kWidth + x] +=
              float(b.gray * std::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / 32));
    }
    GrayImage image{kWidth, kHeight, {}};
    for (const float gray : sum) image.pixels.push_back(uint8_t(std::clamp(gain * double(gray), 0.0, 255.0)));
    return builder_.build(image);
  }

 private:
  struct Blob {
    double x, y, gray;
  };
  std::vector<Blob> blobs_;
  PyramidBuilder builder_{Rectification(kWallCamera), EdgeParams()};
};

TEST(CornerTracks, FollowAShiftToATenthOfAPixelAlsoWhenTheExposureChanges) {
  Wall wall;
  CornerTracks tracks;
  tracks.follow(wall.seen(0, 0), {});
  const std::vector<CornerTrack> first = tracks.view().tracks;
  ASSERT_GE(first.size(), 60u);
  EXPECT_EQ(tracks.view().pinhole.width, kWidth / 2);
  tracks.follow(wall.seen(7, -4, 0.8), {});
  int followed = 0, right = 0;
  for (const CornerTrack& now : tracks.view().tracks)
    for (const CornerTrack& before : first)
      if (now.id == before.id)
        ++followed, right += (now.px - before.px - Eigen::Vector2f(3.5f, -2.f)).norm() < 0.1f;
  EXPECT_GE(followed, 50);
  EXPECT_GE(right, 0.85 * followed);
}

TEST(CornerTracks, AreReplacedAsTheyAreLostAndNumbersAreNotUsedAgain) {
  Wall wall;
  CornerTracks tracks;
  uint32_t newest = 0;
  for (int i = 0; i < 30; ++i) {
    tracks.follow(wall.seen(-6 * i, 0), {});
    const auto& now = tracks.view().tracks;
    ASSERT_GE(now.size(), 40u) << i;
    for (size_t k = 1; k < now.size(); ++k) EXPECT_LT(now[k - 1].id, now[k].id);
    newest = std::max(newest, now.back().id);
  }
  EXPECT_GT(newest, 100u);
}

TEST(CornerTracks, ABlackImageLosesThemAndTheNextFindsNewOnes) {
  Wall wall;
  CornerTracks tracks;
  tracks.follow(wall.seen(0, 0), {});
  const uint32_t last = tracks.view().tracks.back().id;
  tracks.follow(wall.seen(0, 0, 0), {});
  EXPECT_TRUE(tracks.view().tracks.empty());
  tracks.follow(wall.seen(0, 0), {});
  ASSERT_GE(tracks.view().tracks.size(), 60u);
  EXPECT_GT(tracks.view().tracks.front().id, last);
}

// A step past the wall at depth 10, which moves by 5 px in the image.
const SE3 kStep(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0, 0));

// What the witness says after 40 such steps.
std::optional<CornerEvidence> walk(Wall& wall, FeatureTracker* witness) {
  EXPECT_FALSE(witness->add(wall.seen(0, 0), std::nullopt));
  witness->begin_map(0.1);
  std::optional<CornerEvidence> e;
  for (int i = 1; i <= 40; ++i) e = witness->add(wall.seen(5 * i, 0), kStep);
  return e;
}

TEST(FeatureTracker, ImagesOfAStandingCameraContradictSteps) {
  Wall wall;
  FeatureTracker witness;
  std::optional<CornerEvidence> e = walk(wall, &witness);
  ASSERT_TRUE(e);
  EXPECT_GT(e->agreeing_share, 0.9);
  EXPECT_LT(e->motion_error, 0.15);
  for (int i = 0; i < 12; ++i) e = witness.add(wall.seen(200, 0), kStep);
  EXPECT_GT(e->motion_error, 0.8);
}

TEST(FeatureTracker, WhatMovesBeforeACameraThatIsKnownToStandIsNoCrossCheck) {
  for (const bool is_known : {false, true}) {
    Wall wall;
    FeatureTracker witness;
    std::optional<CornerEvidence> e = walk(wall, &witness);
    for (int i = 41; i <= 55; ++i) e = witness.add(wall.seen(5 * i, 0), SE3(), {}, is_known);
    EXPECT_EQ(e->motion_error_depths > 0.02, !is_known);
  }
}

TEST(FeatureTracker, CornersOnWhatMovesByItselfHaveNoSay) {
  const auto tracks_of = [](const MovesByItself& moves) {
    Wall wall;
    FeatureTracker witness;
    witness.begin_map(0.1);
    std::optional<CornerEvidence> e;
    for (int i = 0; i <= 20; ++i) e = witness.add(wall.seen(5 * i, 0), kStep, moves);
    return e ? e->tracks : 0;
  };
  EXPECT_GT(tracks_of({}), 0);
  EXPECT_EQ(tracks_of([](const Eigen::Vector2d&) { return true; }), 0);
}

TEST(FeatureTracker, TwoRunsAreIdentical) {
  const auto run = [] {
    Wall wall;
    FeatureTracker witness;
    return *walk(wall, &witness);
  };
  const CornerEvidence a = run(), b = run();
  EXPECT_EQ(a.tracks, b.tracks);
  EXPECT_EQ(a.motion_error, b.motion_error);
  EXPECT_EQ(a.scale, b.scale);
}

}  // namespace
}  // namespace edgevo
