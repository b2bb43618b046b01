// SPDX-License-Identifier: BSD-3-Clause
// Each witness of a wrong motion alone: the odds that a measured error is beyond the tolerance, given its
// standard deviation; sizes by their logarithm; and that what is unknown stays so.
#include "consistency_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace edgevo {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(ProbabilityBeyond, IsTheMassOutsideTheTolerance) {
  EXPECT_NEAR(probability_beyond(0, 1, 1.96), 0.05, 1e-3);
  EXPECT_NEAR(probability_beyond(3, 0.1, 3), 0.5, 1e-9);
  EXPECT_NEAR(probability_beyond(-3, 0.1, 3), 0.5, 1e-9) << "either way";
  EXPECT_NEAR(probability_beyond(0, 1e6, 3), 1, 1e-5) << "who knows nothing";
  EXPECT_EQ(probability_beyond(2, 0, 3), 0);
  EXPECT_EQ(probability_beyond(4, 0, 3), 1);
  EXPECT_TRUE(std::isnan(probability_beyond(kUnknown, 1, 3)));
  EXPECT_TRUE(std::isnan(probability_beyond(0, kUnknown, 3)));
}

TEST(LogOdds, AreSureToOneInAHundredAtMost) {
  EXPECT_NEAR(log_odds(0.5), 0, 1e-12);
  EXPECT_EQ(log_odds(0), log_odds(1e-9));
  EXPECT_NEAR(log_odds(1), -log_odds(0), 1e-12);
  EXPECT_TRUE(std::isnan(log_odds(kUnknown)));
}

TEST(EvidenceOfCorners, GrowsWithEitherErrorAndIsEvenAtTheTolerance) {
  CornerEvidence c;
  c.motion_error = 0.02, c.motion_sigma = 0.05, c.rotation_sigma_deg = 0.5;
  double before = -1e9;
  for (c.rotation_deg = 0; c.rotation_deg < 6; c.rotation_deg += 0.5) {
    EXPECT_GE(evidence_of_corners(c, 0.5), before);
    before = evidence_of_corners(c, 0.5);
  }
  c.rotation_deg = 3;
  EXPECT_NEAR(evidence_of_corners(c, 0.5), 0, 1e-4);
  c.rotation_deg = 0.1, c.motion_error = 0.25;
  EXPECT_NEAR(evidence_of_corners(c, 0.5), 0, 1e-4) << "a quarter of the length";
  EXPECT_LT(evidence_of_corners(c, 0.01), -4) << "0.25 % of the depth";
}

TEST(EvidenceOfCorners, RestsOnTheRotationWhereTheyKnowNoLength) {
  CornerEvidence c;
  c.rotation_deg = 3, c.rotation_sigma_deg = 0.5;
  EXPECT_NEAR(evidence_of_corners(c, 0.5), 0, 1e-6);
  c.motion_error = 0.02, c.motion_sigma = 20;
  EXPECT_GT(evidence_of_corners(c, 0.5), 3) << "a vague length is no right one";
}

TEST(EvidenceOfMap, IsTheLogarithmOfTolerances) {
  EXPECT_NEAR(evidence_of_map(0.02, 0.01), 0, 1e-12) << "2 % of the depth";
  EXPECT_NEAR(evidence_of_map(0.5, 1), std::log(2), 1e-12) << "half of the way";
  EXPECT_EQ(evidence_of_map(0, 1), evidence_of_map(0.002, 1)) << "nothing";
}

TEST(EvidenceOfTurn, IsThatOfAnErrorInProportionToTheTurn) {
  EXPECT_NEAR(evidence_of_turn(0.2, 0.01, 0.1), evidence_of_turn(0.4, 0.01, 0.05), 1e-12);
  EXPECT_GT(evidence_of_turn(0.4, 0.01, 0.1), 0) << "two standard errors are 2 % of the depth";
  EXPECT_LT(evidence_of_turn(0.4, 1, 0.1), -4) << "a drive around a corner: the way is long";
  EXPECT_LT(evidence_of_turn(0, 0.001, 0.1), -4) << "a camera that stands";
}

TEST(ChangeOfStep, IsTheLogarithmOfTheRatio) {
  EXPECT_EQ(change_of_step(1, 1, 10), 0);
  EXPECT_NEAR(change_of_step(2, 1, 1e-3), std::log(2), 1e-3);
  EXPECT_NEAR(change_of_step(0.5, 1, 1e-3), -std::log(2), 1e-3);
  EXPECT_LT(std::abs(change_of_step(1e-6, 2e-4, 1)), 0.1) << "a camera that stands";
}

TEST(FocalLength, BendsATurnByItsErrorAndWithItsDeviation) {
  EXPECT_NEAR(probability_of_wrong_focal_length(0.25, 0.01, 15), 0.5, 1e-6) << "12 degrees in truth";
  EXPECT_NEAR(probability_of_wrong_focal_length(-0.2, 0.01, 12), 0.5, 1e-6) << "15 degrees in truth";
  EXPECT_LT(probability_of_wrong_focal_length(-0.02, 0.01, 40), 0.01);
  EXPECT_EQ(probability_of_wrong_focal_length(0.25, 0.01, 0), 0);
  EXPECT_LT(probability_of_wrong_focal_length(0.118, 0.057, 40), 0.4) << "two standard deviations off";
  EXPECT_GT(probability_of_wrong_focal_length(0.3, 0.0745, 40), 0.7) << "four";
  EXPECT_EQ(probability_of_wrong_focal_length(kUnknown, kUnknown, 30), 0);
}

TEST(Evidence, OfWhatIsUnknownIsUnknown) {
  const CornerEvidence none;
  EXPECT_TRUE(std::isnan(evidence_of_corners(none, 1)));
  EXPECT_TRUE(std::isnan(evidence_of_map(kUnknown, 1)));
  EXPECT_TRUE(std::isnan(evidence_of_turn(kUnknown, kUnknown, 0.1)));
  EXPECT_TRUE(std::isnan(change_of_step(kUnknown, kUnknown, kUnknown)));
}

}  // namespace
}  // namespace edgevo
