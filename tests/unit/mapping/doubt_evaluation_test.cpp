// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/doubt_evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

const Pinhole kPinhole{300, 300, 160, 120, 320, 240};

// Squares of random size and brightness.
Plane<uint8_t> texture(uint64_t seed) {
  Random random(seed);
  Plane<uint8_t> image(320, 240);
  std::fill_n(image.row(0), 320 * 240, uint8_t(128));
  for (int n = 0; n < 1500; ++n) {
    const int x = int(random.uniform(0, 310)), y = int(random.uniform(0, 230)),
              gray = int(random.uniform(0, 255)), size = int(random.uniform(3, 10));
    for (int v = y; v < y + size; ++v)
      for (int u = x; u < x + size; ++u) image.at(u, v) = uint8_t(gray);
  }
  return image;
}

// The image after a step to the side: far things above, near ones below.
Plane<uint8_t> after_a_step(const Plane<uint8_t>& image) {
  Plane<uint8_t> moved(320, 240);
  for (int v = 0; v < 240; ++v)
    for (int u = 0; u < 320; ++u) moved.at(u, v) = image.at((u + (v < 120 ? 8 : 24)) % 320, v);
  return moved;
}

// A view of `image`, whose near points lie `depth` away in its map.
TrustedReference view(int keyframe, int segment, Plane<uint8_t> image, double depth) {
  auto pyramid = std::make_shared<FramePyramid>();
  pyramid->levels.emplace_back().gray = std::move(image);
  auto reference = std::make_shared<Reference>();
  reference->keyframe_id = keyframe;
  reference->cloud.pyramid = pyramid;
  for (float y = 4; y < 240; y += 8)
    for (float x = 4; x < 320; x += 8) {
      CloudPoint p{};
      p.px = {x, y};
      p.normal = {1, 0};
      p.ray = kPinhole.ray({x, y});
      const double z = y < 120 ? 3 * depth : depth;
      p.idepth = 1 / z;
      p.idepth_sigma = 0.02 / z;
      p.host_keyframe = 1;
      reference->cloud.points.push_back(p);
    }
  return {keyframe, segment, reference};
}

constexpr double kNotAtAll = std::numeric_limits<double>::infinity();

DoubtEvaluation evaluate(const std::vector<TrustedReference>& before, const TrustedReference& now,
                         double known_to = kNotAtAll) {
  return evaluate_doubt(kPinhole, before, now, known_to, [](int) { return 1.0; });
}

class AfterADoubt : public ::testing::Test {
 protected:
  TrustedReference before(int keyframe) const { return view(keyframe, 0, texture(1), 10); }
  TrustedReference failure(int keyframe) const { return view(keyframe, 0, texture(2), 10); }
  TrustedReference now(int segment, double depth) const {
    return view(5, segment, after_a_step(texture(1)), depth);
  }
};

TEST_F(AfterADoubt, WithoutAViewBeforeThereIsNothingToCompare) {
  EXPECT_FALSE(evaluate({}, now(0, 10)).unit);
}

// The newest view is of the failure, which was noticed late.
TEST_F(AfterADoubt, AnEarlierViewLinksWhatTheNewestDoesNot) {
  EXPECT_FALSE(evaluate({failure(3)}, now(1, 20)).unit->is_linked());
  const DoubtEvaluation found = evaluate({failure(3), before(2)}, now(1, 20));
  ASSERT_TRUE(found.unit->is_linked());
  EXPECT_NEAR(found.ended.scale_ratio, 0.5, 0.01);
}

// Within the same map all that came after the newest one was measured in the other unit.
TEST_F(AfterADoubt, WhatCameAfterTheNewestViewIsSetBack) {
  const DoubtEvaluation found = evaluate({failure(3), before(2)}, now(0, 20));
  EXPECT_NEAR(found.ended.scale_ratio, 0.5, 0.01);
  EXPECT_EQ(found.ended.last_trusted_keyframe, 3);
}

// The unit of a new map is an estimate, which a better one replaces; that of one map is kept unless it is
// shown to be wrong.
TEST_F(AfterADoubt, ASmallDifferenceIsOneOfANewMapOnly) {
  EXPECT_NEAR(evaluate({before(3)}, now(1, 10.4)).ended.scale_ratio, 1 / 1.04, 0.005);
  EXPECT_EQ(evaluate({before(3)}, now(0, 10.4)).ended.scale_ratio, 1);
  EXPECT_EQ(evaluate({before(3)}, now(1, 10.4), 0.001).ended.scale_ratio, 1) << "known better";
}

}  // namespace
}  // namespace edgevo
