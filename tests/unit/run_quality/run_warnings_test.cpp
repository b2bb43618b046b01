// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/run_warnings.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CameraPosterior k1_found(double mean, double sigma) {
  CameraPosterior c;
  c.is_sought.fill(true);
  c.given.set(CameraNumber::kK1, mean, sigma);
  c.given.keyframes = 60;
  return c;
}

TEST(RunWarnings, NoneForAGoodRun) {
  edgevo::Run run;
  run.scale_source = "odometry";
  run.scale.lowest = 0.95, run.scale.highest = 1.1;
  run.camera.is_sought.fill(true);
  run.camera.applied.k1 = 0.01;
  EXPECT_THAT(run_warnings(run), IsEmpty());
}

TEST(RunWarnings, AScaleThatVaries) {
  edgevo::Run run;
  run.scale_source = "camera_height=1.65";
  run.scale.lowest = 0.9, run.scale.highest = 2.12;
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("from 0.90 to 2.12")));
}

TEST(RunWarnings, ACalibrationAtItsLimit) {
  edgevo::Run run;
  run.camera = k1_found(0.03, 0.001);
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("0.0300) is at its limit")));
}

TEST(RunWarnings, AFocalLengthThatTheMotionContradicts) {
  edgevo::Run run;
  const auto find = [&](double mean, double sigma) {
    run.camera.whole.set(CameraNumber::kFocal, mean, sigma);
  };
  find(0.05, 0);
  EXPECT_THAT(run_warnings(run), IsEmpty()) << "no estimate";
  find(0.05, 0.01);
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("the focal length is 5.0 +- 2.7 % off")))
      << "half of the 5 % may be missing";
  find(0.05, 0.02);
  EXPECT_THAT(run_warnings(run), IsEmpty());
}

// A wrong camera file is named, and not only straight motion, even where the estimate is too uncertain.
// Corners show most of a large error, matches a part.
TEST(RunWarnings, AFocalLengthThatTheCornersContradict) {
  edgevo::Run run;
  run.frames.resize(3);
  run.frames[1].evidence.focal_error = 0.22, run.frames[1].evidence.focal_error_sigma = 0.08;
  EXPECT_THAT(run_warnings(run), IsEmpty()) << "within three standard deviations";
  run.frames[1].evidence.focal_error_sigma = 0.05;
  run.camera.whole.set(CameraNumber::kFocal, 0.08, 0.01);
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("the focal length is 22.0 +- 5.0 % off")))
      << "the newest frame may lack it";
}

// One warning, of what was done, and not of what the matches say besides.
TEST(RunWarnings, AFocalLengthThatWasCorrected) {
  edgevo::Run run;
  run.camera.applied.focal = 0.22;
  run.camera.whole.set(CameraNumber::kFocal, 0.22, 0.01);
  EXPECT_THAT(
      run_warnings(run),
      ElementsAre(HasSubstr("22.0 +- 1.0 % off the camera file's, by the motion, and was corrected")));
}

TEST(RunWarnings, AnUncertainCalibrationAtItsLimit) {
  edgevo::Run run;
  run.camera = k1_found(-0.03, 0.02);
  EXPECT_EQ(run.camera.state_of(CameraNumber::kK1), CameraPosterior::State::kNotObservable);
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("the camera file is probably wrong")));
  run.camera = k1_found(0.02, 0.02);
  EXPECT_FALSE(run.camera.is_at_limit(CameraNumber::kK1));
  EXPECT_THAT(run_warnings(run), IsEmpty());
}

TEST(RunWarnings, ImagesThatAreNoOneExposureAreCounted) {
  edgevo::Run run;
  run.frames.resize(10);
  EXPECT_TRUE(run_warnings(run).empty());
  run.frames[3].evidence.fault = run.frames[6].evidence.fault = ImageFault::kTorn;
  ASSERT_EQ(run_warnings(run).size(), 1u);
  EXPECT_THAT(run_warnings(run)[0], ::testing::HasSubstr("2 of 10 images are torn"));
}

}  // namespace
}  // namespace edgevo
