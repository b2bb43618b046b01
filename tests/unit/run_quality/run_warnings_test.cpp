// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/run_warnings.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(RunWarnings, NoneForAGoodRun) {
  edgevo::Run run;
  run.scale_source = "odometry";
  run.scale.lowest = 0.95, run.scale.highest = 1.1;
  run.camera.state = CameraRefinement::State::kApplied;
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
  run.camera.state = CameraRefinement::State::kAtLimit;
  run.camera.estimate = 0.03;
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("0.0300) is at its limit")));
}

TEST(RunWarnings, AFocalLengthThatTheMotionContradicts) {
  edgevo::Run run;
  run.camera.lens.focal = 0.05;
  EXPECT_THAT(run_warnings(run), IsEmpty()) << "no estimate";
  run.camera.lens.focal_sigma = 0.01;
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("the focal length is 5.0 +- 1.0 % off")));
  run.camera.lens.focal_sigma = 0.02;
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("the focal length is 5.0 +- 2.0 % off")));
  run.camera.lens.focal_sigma = 0.03;
  EXPECT_THAT(run_warnings(run), IsEmpty());
  run.camera.lens.focal = 0.025, run.camera.lens.focal_sigma = 0.01;
  EXPECT_THAT(run_warnings(run), IsEmpty()) << "as far as a right camera may seem off";
}

// A wrong camera file is named, and not only straight motion, even where the estimate is too uncertain.
// Corners show most of a large error, matches a part.
TEST(RunWarnings, AFocalLengthThatTheCornersContradict) {
  edgevo::Run run;
  run.frames.resize(3);
  run.frames[1].evidence.focal_error = 0.22, run.frames[1].evidence.focal_error_sigma = 0.08;
  EXPECT_THAT(run_warnings(run), IsEmpty()) << "within three standard deviations";
  run.frames[1].evidence.focal_error_sigma = 0.05;
  run.camera.lens.focal = 0.08, run.camera.lens.focal_sigma = 0.01;
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("the focal length is 22.0 +- 5.0 % off")))
      << "the newest frame may lack it";
}

// One warning, of what was done, and not of what the matches say besides.
TEST(RunWarnings, AFocalLengthThatWasCorrected) {
  edgevo::Run run;
  run.camera.correction.focal = 0.22;
  run.camera.lens.focal = 0.2, run.camera.lens.focal_sigma = 0.01;
  EXPECT_THAT(
      run_warnings(run),
      ElementsAre(HasSubstr("22.0 +- 1.0 % off the camera file's, by the motion, and was corrected")));
}

TEST(RunWarnings, AnUncertainCalibrationAtItsLimit) {
  edgevo::Run run;
  run.camera.state = CameraRefinement::State::kNotObservable;
  run.camera.estimate = -0.03;
  run.camera.sigma = 0.006;
  EXPECT_THAT(run_warnings(run), ElementsAre(HasSubstr("the camera file is probably wrong")));
  EXPECT_TRUE(ran_to_limit(run.camera));
  run.camera.estimate = 0.02;
  EXPECT_FALSE(ran_to_limit(run.camera));
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
