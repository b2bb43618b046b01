// SPDX-License-Identifier: BSD-3-Clause
// Foreign bodies pasted over images: deterministic, and exactly where the masks say.
#include "edgevo/simulation/overlay.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr int kOverlayWidth = 620, kOverlayHeight = 190;

GrayImage overlay_image() {
  return {kOverlayWidth, kOverlayHeight, std::vector<uint8_t>(size_t(kOverlayWidth) * kOverlayHeight, 250)};
}

double overlay_black_share(const std::vector<uint8_t>& mask) {
  return double(std::count(mask.begin(), mask.end(), 0)) / double(mask.size());
}

OverlayOptions part(const std::string& kind, double share) {
  OverlayOptions options;
  options.own_part = kind;
  options.part_share = share;
  return options;
}

class EgoMaskMonitor : public ::testing::TestWithParam<std::string> {};

TEST_P(EgoMaskMonitor, CoverTheirShareAndNothingElse) {
  const Overlay overlay(part(GetParam(), 0.2), kOverlayWidth, kOverlayHeight);
  EXPECT_NEAR(overlay_black_share(overlay.own_part_mask()), 0.2, 0.04);
  const OverlaidImage out = overlay.apply(overlay_image(), 5, 0.5, std::nullopt);
  EXPECT_TRUE(out.moving.empty());
  int changed = 0;
  for (size_t i = 0; i < out.image.pixels.size(); ++i) {
    if (overlay.own_part_mask()[i] == 255) changed += out.image.pixels[i] != 250;
  }
  // An arm throws a shadow, in which the scene is seen.
  EXPECT_LT(changed, GetParam() == "arm" ? 9000 : 1600)
      << "only pixels that the outline covers by less than half";
}

TEST_P(EgoMaskMonitor, GiveTheSameBytesAgainAndOtherNoiseInAnotherFrame) {
  const Overlay a(part(GetParam(), 0.1), kOverlayWidth, kOverlayHeight),
      b(part(GetParam(), 0.1), kOverlayWidth, kOverlayHeight);
  const auto bytes = [](const Overlay& o, int index) {
    return o.apply(overlay_image(), index, 0.1 * index, std::nullopt).image.pixels;
  };
  EXPECT_EQ(bytes(a, 3), bytes(b, 3));
  EXPECT_NE(bytes(a, 3), bytes(a, 4));
}

INSTANTIATE_TEST_SUITE_P(Overlay, EgoMaskMonitor, ::testing::ValuesIn(own_part_kinds()));

TEST(Overlay, AVehicleAheadIsWidestWhileItIsFollowed) {
  OverlayOptions options;
  options.vehicle_px = 300;
  const Overlay overlay(options, kOverlayWidth, kOverlayHeight);
  const auto share = [&](double seconds) {
    return overlay_black_share(overlay.apply(overlay_image(), 0, seconds, std::nullopt).moving);
  };
  EXPECT_TRUE(overlay.apply(overlay_image(), 0, 2.9, std::nullopt).moving.empty());
  EXPECT_LT(share(4), share(6));
  EXPECT_LT(share(6), share(8));
  EXPECT_NEAR(share(7.5), share(8.5), 0.01);
  EXPECT_GT(share(8), share(10));
}

TEST(Overlay, ABusCrossesFromLeftToRightAndIsGone) {
  OverlayOptions options;
  options.crossing_px = 900;
  options.standing = 80;
  const Overlay overlay(options, kOverlayWidth, kOverlayHeight);
  const auto share = [&](int standing) {
    return overlay_black_share(overlay.apply(overlay_image(), standing, 0, standing).moving);
  };
  EXPECT_EQ(share(0), 0);
  EXPECT_GT(share(40), 0.3);
  EXPECT_EQ(share(79), 0);
}

TEST(Overlay, VehiclesPassOnTheNextLane) {
  OverlayOptions options;
  options.passing = "oncoming";
  const auto share = [&](double seconds) {
    const std::vector<uint8_t> mask = Overlay(options, kOverlayWidth, kOverlayHeight)
                                          .apply(overlay_image(), 0, seconds, std::nullopt)
                                          .moving;
    return mask.empty() ? 0 : overlay_black_share(mask);
  };
  EXPECT_LT(share(1.0), share(3.0)) << "it comes nearer";
  options.passing = "overtaking";
  EXPECT_GT(share(6.8), share(9.0)) << "it drives away";
  options.passing = "oncomming";
  EXPECT_THROW(share(1), InputError);
}

TEST(Overlay, ABonnetReflectsWhatIsAboveTheHorizon) {
  const Overlay overlay(part("bonnet", 0.2), kOverlayWidth, kOverlayHeight);
  GrayImage dark = overlay_image();
  std::fill(dark.pixels.begin(), dark.pixels.begin() + 40 * kOverlayWidth, uint8_t(0));
  const size_t pixel = size_t(kOverlayHeight - 12) * kOverlayWidth + 100;
  const auto value = [&](const GrayImage& scene) {
    return int(overlay.apply(scene, 0, 0, std::nullopt).image.pixels[pixel]);
  };
  EXPECT_GT(value(overlay_image()), value(dark) + 40);
}

TEST(Overlay, GroundTruthStandsAndGoesOnLater) {
  EXPECT_EQ(ground_truth_with_stop("# t x\n0 a\n1 b\n2 c\n", Timestamp::from_seconds(1), 0.5, 2),
            "# t x\n0.0000000 a\n1.0000000 b\n1.5000000 b\n2.0000000 b\n3.0000000 c\n");
}

TEST(Overlay, RefusesWhatItCannotDo) {
  EXPECT_THROW(Overlay(OverlayOptions(), kOverlayWidth, kOverlayHeight), InputError) << "nothing";
  EXPECT_THROW(Overlay(part("grippr", 0.1), kOverlayWidth, kOverlayHeight), InputError);
  OverlayOptions bus;
  bus.crossing_px = 500;
  EXPECT_THROW(Overlay(bus, kOverlayWidth, kOverlayHeight), InputError) << "the camera moves";
}

}  // namespace
}  // namespace edgevo
