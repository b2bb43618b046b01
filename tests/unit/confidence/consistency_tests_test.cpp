// SPDX-License-Identifier: BSD-3-Clause
// Each witness of a wrong motion alone: a doubt of 0 where nothing speaks against the motion, 1 where the
// motion counts as wrong or as good as that, more for more, never above 3, and a value for what is unknown.
#include "consistency_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace edgevo {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Corners that agree with the poses.
CornerEvidence good_corners() {
  CornerEvidence c;
  c.tracks = 90;
  c.agreeing_share = 1;
  c.change_10 = c.change_50 = 0, c.change_10_sigma = c.change_50_sigma = 0.02;
  c.motion_error = 0.02, c.motion_sigma = 0.03, c.motion_error_depths = 0.005;
  c.rotation_deg = 0.05, c.rotation_sigma_deg = 0.1;
  return c;
}

TEST(DoubtOfCornerMotion, IsOneWhereTheMotionCountsAsWrong) {
  CornerEvidence c = good_corners();
  EXPECT_EQ(inconsistency_of_corner_motion(c), 0);
  c.motion_error = 0.25 + 2.5 * c.motion_sigma, c.motion_error_depths = 0.5;
  EXPECT_NEAR(inconsistency_of_corner_motion(c), 1, 1e-9) << "a quarter beyond 2.5 standard deviations";
  c = good_corners();
  c.rotation_deg = 3.1, c.agreeing_share = 0.6;
  EXPECT_NEAR(inconsistency_of_corner_motion(c), 1, 1e-9) << "3 degrees beyond it";
}

TEST(DoubtOfCornerMotion, DoesNotMindAnErrorThatIsSmallAgainstTheDepth) {
  CornerEvidence c = good_corners();
  c.motion_error = 0.9, c.motion_error_depths = 0.001;
  EXPECT_LE(inconsistency_of_corner_motion(c), 0.05 + 1e-9);
}

TEST(DoubtOfCornerMotion, GoesByTheRotationAloneOnTheSpot) {
  CornerEvidence c = good_corners();
  c.motion_error = 1, c.motion_error_depths = 0.1, c.change_10_sigma = 0.5;
  EXPECT_EQ(inconsistency_of_corner_motion(c), 0);
  c.rotation_deg = 3.1, c.agreeing_share = 0.6;
  EXPECT_NEAR(inconsistency_of_corner_motion(c), 1, 1e-9);
}

TEST(DoubtOfCornerMotion, BelievesARotationOnlyIfCornersBreakTheEpipolarConstraint) {
  CornerEvidence c = good_corners();
  c.rotation_deg = 9;
  EXPECT_EQ(inconsistency_of_corner_motion(c), 0);
  c.agreeing_share = kUnknown;
  EXPECT_GT(inconsistency_of_corner_motion(c), 2.9) << "fast motion: no corner lives long enough";
}

TEST(DoubtOfCornerMotion, DoesNotTrustUncertainCorners) {
  CornerEvidence c = good_corners();
  c.motion_error = 0.9, c.motion_sigma = 1, c.motion_error_depths = 0.5;
  EXPECT_EQ(inconsistency_of_corner_motion(c), 0);
}

TEST(DoubtOfFocalLength, IsOneWhereItTurnsThreeDegreesTooFarOrNotFarEnough) {
  EXPECT_NEAR(inconsistency_of_focal_length(0.25, 0.06, 15), 1, 1e-9) << "12 degrees in truth";
  EXPECT_NEAR(inconsistency_of_focal_length(-0.2, 0.05, 12), 1, 1e-9) << "15 degrees in truth";
  EXPECT_EQ(inconsistency_of_focal_length(-0.082, 0.046, 40), 0) << "as far off as right cameras get";
  EXPECT_EQ(inconsistency_of_focal_length(0.25, 0.01, 0), 0);
  EXPECT_EQ(inconsistency_of_focal_length(std::nan(""), std::nan(""), 30), 0);
}

TEST(DoubtOfCornerScale, CountsAUnitThatFallsRisesOrCreeps) {
  EXPECT_EQ(inconsistency_of_corner_scale(good_corners()), 0);
  for (const double change : {-std::log(1.25) - 0.02, std::log(1.25) + 0.02}) {
    CornerEvidence sudden = good_corners(), creeping = good_corners();
    sudden.change_10 = creeping.change_50 = change;
    EXPECT_NEAR(inconsistency_of_corner_scale(sudden), 1, 1e-2);
    EXPECT_NEAR(inconsistency_of_corner_scale(creeping), 1, 1e-2);
  }
  CornerEvidence collapsed = good_corners();
  collapsed.change_10 = 15;
  EXPECT_EQ(inconsistency_of_corner_scale(collapsed), kMaxInconsistency)
      << "a factor of three million is no more than certain";
}

TEST(DoubtOfCornerAgreement, IsOneIfHalfOfTheCornersContradict) {
  CornerEvidence c = good_corners();
  EXPECT_EQ(inconsistency_of_corner_agreement(c), 0);
  c.agreeing_share = 0.5;
  EXPECT_EQ(inconsistency_of_corner_agreement(c), 1);
}

TEST(InconsistencyWithoutCrossCheck, IsOneUnlessCornersAreCertain) {
  constexpr double kSure = 0.001, kNoInformation = 0.1;
  EXPECT_EQ(inconsistency_without_cross_check(good_corners(), kNoInformation), 0);
  EXPECT_EQ(inconsistency_without_cross_check(std::nullopt, kSure), 1);
  CornerEvidence few = good_corners(), blind = good_corners(), fresh = good_corners();
  few.tracks = 14;
  blind.motion_sigma = 0.3, blind.motion_error_depths = 0.1;
  fresh.motion_sigma = fresh.motion_error_depths = kUnknown;
  for (const CornerEvidence& c : {few, blind, fresh}) {
    EXPECT_EQ(inconsistency_without_cross_check(c, kSure), 1);
    for (const double sigma : {kNoInformation, kUnknown})
      EXPECT_EQ(inconsistency_without_cross_check(c, sigma), kMaxInconsistency)
          << "the image knows nothing, either";
  }
}

TEST(InconsistencyWithoutCrossCheck, LetsACameraThatStandsBe) {
  CornerEvidence standing = good_corners();
  standing.motion_sigma = 5, standing.motion_error_depths = 0.001;
  EXPECT_EQ(inconsistency_without_cross_check(standing, 1), 0);
}

TEST(DoubtOfTurn, IsOneWhereTheTurnMakesTheMotionWrong) {
  EXPECT_NEAR(inconsistency_of_turn(0.4, 0.05, 0.05), 1, 1e-9) << "an error of 2 % of the depth";
  EXPECT_NEAR(inconsistency_of_turn(0.4, 0.16, 0.1), 1, 1e-9) << "an error of a quarter of the length";
  EXPECT_LT(inconsistency_of_turn(0.5, 1, 0.05), 0.11) << "a drive around a corner: the way is long";
  EXPECT_EQ(inconsistency_of_turn(0, 0.001, 0.1), 0) << "a camera that stands";
}

TEST(DoubtOfTurn, RestsOnTurnsAlone) {
  CornerEvidence c = good_corners();
  c.motion_error_depths = 0.03;
  EXPECT_NEAR(turn_error(c, 0.3), 0.1, 1e-9);
  EXPECT_TRUE(std::isnan(turn_error(c, 0.01)));
  EXPECT_EQ(inconsistency_of_turn(0.4, 0.05, kUnknown), 0);
}

TEST(DoubtOfStep, IsTheLogarithmOfTheRatioEitherWay) {
  EXPECT_EQ(inconsistency_of_step(1, 1, 10), 0);
  EXPECT_NEAR(inconsistency_of_step(2, 1, 1e-3), std::log(2), 1e-3);
  EXPECT_NEAR(inconsistency_of_step(0.5, 1, 1e-3), std::log(2), 1e-3);
  EXPECT_EQ(inconsistency_of_step(5, 1, 1e-3), 1) << "a camera may speed up";
  EXPECT_LT(inconsistency_of_step(1e-6, 2e-4, 1), 0.1) << "a camera that stands";
}

TEST(DoubtOfResidual, IsTheLogarithmOverThatOfRightRuns) {
  EXPECT_EQ(inconsistency_of_residual(0.5), 0);
  EXPECT_NEAR(inconsistency_of_residual(1.2), std::log(2), 1e-9);
  EXPECT_EQ(inconsistency_of_residual(0), 0) << "nothing was matched: that is starvation";
}

TEST(DoubtOfAdjustment, IsZeroUpToTheExpectedMove) {
  EXPECT_EQ(inconsistency_of_adjustment(1), 0);
  EXPECT_NEAR(inconsistency_of_adjustment(std::exp(0.5)), 0.5, 1e-9);
  EXPECT_EQ(inconsistency_of_adjustment(100), 1);
}

TEST(DoubtOfStarvation, CountsOutliersAndMissingPoints) {
  FrameEvidence e;
  e.inlier_share = 0.7, e.known_points = 300, e.view_share = 0.9;
  EXPECT_EQ(inconsistency_of_starvation(e), 0);
  e.inlier_share = 0.4;
  EXPECT_NEAR(inconsistency_of_starvation(e), 1, 1e-9);
  e.known_points = 40;
  EXPECT_NEAR(inconsistency_of_starvation(e), 2, 0.02);
  e.view_share = 0.15;
  EXPECT_NEAR(inconsistency_of_starvation(e), 2.5, 0.02);
  EXPECT_NEAR(inconsistency_of_starvation(FrameEvidence()), 0.7 / 0.3, 1e-9) << "not tracked";
}

TEST(DoubtOfImage, CountsBlurBeyondWhatIsUsualAndSaturation) {
  EXPECT_EQ(inconsistency_of_image(0.46, 0.46, 0, 0), 0);
  EXPECT_NEAR(inconsistency_of_image(0.6, 0.46, 0, 0), 1, 1e-9);
  EXPECT_EQ(inconsistency_of_image(0.7, 0.7, 0, 0), 0) << "a lens that is always soft";
  EXPECT_NEAR(inconsistency_of_image(0.46, 0.46, 0.3, 0), 1, 1e-9);
  EXPECT_EQ(inconsistency_of_image(0.46, 0.46, 0.4, 0.4), 0) << "a black background";
}

TEST(Inconsistencies, UnknownEvidenceHasADefinedValue) {
  const CornerEvidence none;
  for (const double doubt :
       {inconsistency_of_corner_motion(none), inconsistency_of_corner_scale(none),
        inconsistency_of_corner_agreement(none), inconsistency_of_turn(kUnknown, kUnknown, kUnknown),
        inconsistency_of_step(kUnknown, kUnknown, kUnknown), inconsistency_of_adjustment(kUnknown),
        inconsistency_of_residual(kUnknown), inconsistency_of_image(kUnknown, kUnknown, kUnknown, kUnknown)})
    EXPECT_EQ(doubt, 0) << "what is not known is no suspicion; that nothing is known is one of its own";
  EXPECT_EQ(inconsistency_without_cross_check(none, 0.001), 1);
}

}  // namespace
}  // namespace edgevo
