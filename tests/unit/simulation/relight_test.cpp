// SPDX-License-Identifier: BSD-3-Clause
// Lighting changes: deterministic, as strong as documented, and only where they should be.
#include "edgevo/simulation/relight.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "edgevo/core/error.h"
#include "edgevo/simulation/relit_source.h"
#include "edgevo/simulation/rendered_source.h"
#include "edgevo/simulation/texture.h"

namespace edgevo {
namespace {

GrayImage flat(uint8_t gray) { return {320, 200, std::vector<uint8_t>(320 * 200, gray)}; }

double mean(const GrayImage& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / double(image.pixels.size());
}

class RelightKinds : public ::testing::TestWithParam<std::string> {};

TEST_P(RelightKinds, SameBytesInAnyOrderAndOtherSeedDiffers) {
  GrayImage image = flat(0);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = uint8_t((i * 7) % 256);
  const Relight a(GetParam(), 3), b(GetParam(), 3), other(GetParam(), 4);
  const GrayImage later = a.apply(image, 40, 4.0), first = a.apply(image, 2, 0.2);
  EXPECT_EQ(b.apply(image, 2, 0.2).pixels, first.pixels);
  EXPECT_EQ(b.apply(image, 40, 4.0).pixels, later.pixels);
  EXPECT_EQ(later.width, 320);
  const bool follows_seed = GetParam() != "vignette" && GetParam() != "blooming" && GetParam() != "dropped";
  EXPECT_EQ(other.apply(image, 40, 4.0).pixels != later.pixels, follows_seed);
}

INSTANTIATE_TEST_SUITE_P(Relight, RelightKinds, ::testing::ValuesIn(relight_kinds()));

TEST(Relight, JumpsAreSuddenAndLarge) {
  const Relight jumps("jumps", 1);
  double largest = 0, previous = 100;
  for (int i = 0; i < 200; ++i) {
    const double now = mean(jumps.apply(flat(100), i, i / 10.0));
    largest = std::max(largest, std::abs(std::log(now / previous)));
    previous = now;
  }
  EXPECT_GT(largest, std::log(1.4));
  EXPECT_LE(largest, 2 * std::log(2.25));  // from one jump straight into the opposite one
}

TEST(Relight, DriftIsSlowButFar) {
  const Relight drift("drift", 1);
  double low = 255, high = 0, previous = mean(drift.apply(flat(100), 0, 0));
  for (int i = 1; i < 600; ++i) {
    const double now = mean(drift.apply(flat(100), i, i / 10.0));
    EXPECT_LT(std::abs(now - previous), 12) << i;
    low = std::min(low, now), high = std::max(high, now), previous = now;
  }
  EXPECT_GT(high - low, 40);
}

TEST(Relight, VignetteKeepsTheMiddle) {
  const GrayImage dimmed = Relight("vignette", 1).apply(flat(200), 0, 0);
  EXPECT_NEAR(dimmed.view().at(160, 100), 200, 1);
  EXPECT_NEAR(dimmed.view().at(0, 0), 0.35 * 200, 3);
}

TEST(Relight, GlareSaturates) {
  const Relight glare("glare", 1);
  int brightest = 0;
  for (int i = 0; i < 20; ++i) {
    const GrayImage lit = glare.apply(flat(60), i, i);
    brightest = std::max<int>(brightest, *std::max_element(lit.pixels.begin(), lit.pixels.end()));
  }
  EXPECT_EQ(brightest, 255);
}

TEST(Relight, SkyBloomsIntoTheForeground) {
  GrayImage image = flat(60);
  for (int v = 0; v < 100; ++v) std::fill_n(image.pixels.begin() + v * 320, 320, uint8_t(240));
  const GrayImage bloomed = Relight("blooming", 1).apply(image, 0, 0);
  EXPECT_GT(bloomed.view().at(160, 101), 140);
  EXPECT_EQ(bloomed.view().at(160, 110), 60);
}

TEST(Relight, NoiseHasItsStrength) {
  const GrayImage noisy = Relight("noise", 1).apply(flat(120), 5, 0.5);
  double sum2 = 0;
  for (uint8_t g : noisy.pixels) sum2 += (g - 120.0) * (g - 120.0);
  EXPECT_NEAR(std::sqrt(sum2 / double(noisy.pixels.size())), 8, 0.3);
}

TEST(Relight, DropsOneFrameInTwelveButNotTheFirst) {
  const Relight dropped("dropped", 1);
  int count = 0;
  for (int i = 0; i < 1200; ++i) count += dropped.drops(i);
  EXPECT_NEAR(count, 100, 35);
  EXPECT_FALSE(dropped.drops(0));
  EXPECT_FALSE(Relight("mixed", 1).drops(7));
}

TEST(RelitSource, KeepsNumbersTimesAndCalibrationAndSkipsDroppedFrames) {
  const auto renderer = std::make_shared<SceneRenderer>(load_scene("corridor"));
  const Relight dropped("dropped", 2);
  RelitSource source(std::make_unique<RenderedSource>(renderer, 0, 30), dropped);
  EXPECT_FALSE(source.size());
  EXPECT_EQ(source.camera().pinhole().fx, renderer->camera().pinhole().fx);
  std::vector<int> kept, expected;
  while (const auto frame = source.next()) {
    EXPECT_EQ(frame->time, renderer->scene().times[size_t(frame->index)]);
    kept.push_back(frame->index);
  }
  for (int i = 0; i < 30; ++i)
    if (!dropped.drops(i)) expected.push_back(i);
  EXPECT_EQ(kept, expected);
  EXPECT_LT(kept.size(), 30u);
}

TEST(Relight, UnknownKindOffersTheNearest) {
  try {
    Relight("glair", 1);
    ADD_FAILURE() << "was accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("did you mean glare?"));
  }
}

TEST(Relight, AnImageWithFewerPixelsThanItsSizeIsRefused) {
  EXPECT_THROW(Relight("mixed", 1).apply({64, 48, std::vector<uint8_t>(1000)}, 0, 0), InputError);
  EXPECT_THROW(make_texture({64, 64, std::vector<uint8_t>(1000)}), InputError);
}

}  // namespace
}  // namespace edgevo
