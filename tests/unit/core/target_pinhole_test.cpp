// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/target_pinhole.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/rectification.h"
#include "support/camera_examples.h"

namespace edgevo {
namespace {

constexpr double kDegree = M_PI / 180;

Camera fisheye(double view_deg, int width, int height) {
  const double f = width / (view_deg * kDegree);
  Camera camera;
  camera.model = KannalaBrandtModel{};
  camera.set_pinhole({f, f, width / 2.0 - 0.5, height / 2.0 - 0.5, width, height});
  return camera;
}

double degrees(double radians) { return radians / kDegree; }

class EachTarget : public ::testing::TestWithParam<test::CameraExample> {
 protected:
  const Camera& camera() const { return GetParam().camera; }
};

TEST_P(EachTarget, TheMiddleKeepsItsFocalLengthOrIsUpToAQuarterFiner) {
  const Pinhole target = target_pinhole(camera()), raw = camera().pinhole();
  const double scale = target.fx / raw.fx;
  EXPECT_NEAR(target.fy / raw.fy, scale, 1e-12);
  if (camera().plumb_bob()) {
    EXPECT_EQ(scale, 1);
    return;
  }
  EXPECT_GE(scale, 1);
  EXPECT_LE(scale, 1.25);
  const double pixels = double(target.width) * target.height;
  EXPECT_TRUE(scale == 1 || pixels < 1.01 * 720000) << pixels;
  EXPECT_TRUE(scale > 1.249 || pixels > 0.99 * 720000) << pixels;
}

TEST_P(EachTarget, OfOtherLensesTheUsualOneReachesAsFarAsTheLensButNotBeyond60Degrees) {
  if (camera().plumb_bob()) return;
  const ViewAngles raw = view_angles(camera()), seen = view_angles(Camera(target_pinhole(camera())));
  const double largest = 60 * kDegree, half_a_pixel = 0.5 / camera().pinhole().fx;
  EXPECT_NEAR(seen.left, std::min(raw.left, largest), half_a_pixel);
  EXPECT_NEAR(seen.right, std::min(raw.right, largest), half_a_pixel);
  EXPECT_NEAR(seen.up, std::min(raw.up, largest), half_a_pixel);
  EXPECT_NEAR(seen.down, std::min(raw.down, largest), half_a_pixel);
}

TEST_P(EachTarget, ARequestedSizeIsKeptAndLeavesNoSideUnfilled) {
  for (const auto& [width, height] : {std::pair(400, 300), {300, 400}, {900, 200}}) {
    const Pinhole target = target_pinhole(camera(), {100.0, width, height});
    EXPECT_EQ(target.width, width);
    EXPECT_EQ(target.height, height);
    EXPECT_NEAR(target.fx / target.fy, camera().pinhole().fx / camera().pinhole().fy, 1e-12);
    const ViewAngles raw = view_angles(camera()), seen = view_angles(Camera(target));
    EXPECT_LT(seen.horizontal(), 100.01 * kDegree);
    EXPECT_LT(seen.left, raw.left + 1e-6);
    EXPECT_LT(seen.down, raw.down + 1e-6);
    Rectification(camera(), target).check("target");
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, EachTarget, ::testing::ValuesIn(test::camera_examples()), test::name_of);

TEST(TargetPinhole, AFisheyeOf100DegreesIsShownWhole) {
  const Camera camera = fisheye(100, 640, 480);
  const Pinhole target = target_pinhole(camera);
  EXPECT_NEAR(degrees(view_angles(Camera(target)).horizontal()), 100, 0.1);
  EXPECT_NEAR(target.width, 2 * target.fx * std::tan(50 * kDegree), 1);
  EXPECT_TRUE(Rectification(camera).maps().missing.empty());
}

TEST(TargetPinhole, BeyondItsViewWhatIsCutOffIsCountedAndSaid) {
  const Camera camera = fisheye(190, 600, 600);
  const Pinhole target = target_pinhole(camera);
  const double share = cropped_share(camera, target);
  EXPECT_GT(share, 0.3);
  EXPECT_LT(share, 0.7);
  const InputDecision d = describe_target(camera, target);
  EXPECT_NE(d.value.find("120 x 120 degrees"), std::string::npos) << d.value;
  EXPECT_NE(d.reason.find("190 x 190 degrees"), std::string::npos) << d.reason;
  EXPECT_NE(d.reason.find(std::to_string(std::lround(100 * share)) + " % of the image"), std::string::npos);
  const Camera pinhole(Pinhole{300, 300, 319.5, 239.5, 640, 480});
  EXPECT_NE(describe_target(pinhole, target_pinhole(pinhole)).reason.find("nothing is cut off"),
            std::string::npos);
}

TEST(TargetPinhole, AnotherViewMayBeRequestedOfEachLens) {
  const Camera lens = fisheye(160, 640, 480), pinhole(Pinhole{300, 300, 319.5, 239.5, 640, 480});
  for (const double requested : {60.0, 90.0, 140.0})
    EXPECT_NEAR(degrees(view_angles(Camera(target_pinhole(lens, {requested, 0, 0}))).horizontal()), requested,
                0.2);
  EXPECT_NEAR(degrees(view_angles(Camera(target_pinhole(pinhole, {60.0, 0, 0}))).horizontal()), 60, 0.2);
  EXPECT_TRUE(target_pinhole(pinhole) == pinhole.pinhole());
}

}  // namespace
}  // namespace edgevo
