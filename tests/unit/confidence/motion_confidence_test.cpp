// SPDX-License-Identifier: BSD-3-Clause
// The probability of a right motion: never higher for more doubt, falling smoothly as witnesses go, and on
// made runs high while all is well, low soon after the unit of the map has changed.
#include "edgevo/confidence/motion_confidence.h"

#include <gmock/gmock.h>

#include <cmath>

#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/doubtful_frame.h"
#include "trust_table.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

constexpr double kStep = 0.8, kDepth = 15;

FrameEvidence good_evidence() {
  FrameEvidence e;
  e.edges = 20000;
  e.saturated_share = 0.01, e.edge_blur = 0.47, e.median_depth = kDepth;
  e.visible_points = 1800, e.matched_points = 1700;
  e.inlier_share = 0.93, e.residual_px = 0.5;
  e.pose_sigmas.fill(5e-4);
  e.step_sigmas = 0.5;
  e.known_points = 1500, e.lacking_share = 0.05, e.view_share = 0.8;
  e.moved_by_map = 1e-3;
  CornerEvidence c;
  c.tracks = 90, c.agreeing_share = 0.97;
  c.scale = 0, c.scale_sigma = 0.02;
  c.change_10 = 0.01, c.change_10_sigma = 0.03, c.change_50 = 0, c.change_50_sigma = 0.03;
  c.motion_error = 0.03, c.motion_sigma = 0.03, c.motion_error_depths = 0.01;
  c.rotation_deg = 0.05, c.rotation_sigma_deg = 0.05;
  c.direction_deg = 1, c.direction_sigma_deg = 1;
  e.corners = c;
  return e;
}

// A drive along z.
class Drive {
 public:
  FrameConfidence go(const FrameEvidence& evidence, double step = kStep, int frames = 1) {
    FrameConfidence newest;
    for (int i = 0; i < frames; ++i) newest = trust.add({evidence, next(step, evidence.stands)});
    return newest;
  }
  MotionHistory::Newest next(double step = kStep, bool stands = false) {
    z_ += step;
    history.add(
        {SE3(Eigen::Quaterniond(Eigen::AngleAxisd(turn_ += turn, Eigen::Vector3d::UnitY())), {0, 0, z_}),
         {},
         1,
         stands});
    return history.newest();
  }
  MotionConfidence trust;
  MotionHistory history;
  double turn = 0;  // radians a frame

 private:
  double z_ = 0, turn_ = 0;
};

// Of right motions.
Inconsistencies usual() {
  Inconsistencies doubts;
  for (const trust_table::Term& term : trust_table::kTerms) doubts[size_t(term.doubt)] = term.usual;
  return doubts;
}

// By the error of the unit that keyframes have carried, smoothly; and for as long as a unit is compared over.
TEST(MotionConfidence, AUnitThatIsCarriedBadlyIsDoubted) {
  double before = 1;
  for (const double sigma : {0.0, 0.05, 0.1, 0.2, 0.4, 0.8}) {
    Drive drive;
    drive.go(good_evidence(), kStep, 80);
    AdjustmentEvidence adjustment;
    adjustment.moved = 1, adjustment.unit_variance = sigma * sigma;
    drive.trust.add_adjustment(adjustment);
    const FrameConfidence found = drive.go(good_evidence());
    EXPECT_NEAR(found.unit_sigma, sigma, 1e-9);
    EXPECT_LE(found.p_right, before);
    EXPECT_LT(before - found.p_right, 0.5);
    before = found.p_right;
    if (sigma > 0.7) {
      EXPECT_THAT(to_string(found.reasons), HasSubstr("carried on to 80 %"));
      EXPECT_GT(drive.go(good_evidence(), kStep, 50).p_right, 0.9);
    }
  }
  EXPECT_LT(before, kDoubtfulBelow);
}

TEST(PRight, NeverRisesWithADoubt) {
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    Inconsistencies doubts = usual();
    double before = p_right(doubts);
    for (int i = 0; i < 30; ++i) {
      doubts[k] += 0.1;
      const double p = p_right(doubts);
      EXPECT_LE(p, before) << trust_table::kTerms[k].name;
      before = p;
    }
  }
}

TEST(PRight, IsAProbability) {
  Inconsistencies all = usual();
  for (double& doubt : all) doubt += 3;
  EXPECT_LT(p_right(all), kDoubtfulBelow);
  EXPECT_GE(p_right(all), 0);
  EXPECT_GT(p_right(usual()), 0.95);
  EXPECT_LE(p_right(usual()), 1);
  EXPECT_NEAR(p_right(usual(), 0.25), 0.75 * p_right(usual()), 1e-12) << "the focal length may be wrong";
}

TEST(TrustTable, HasATermForEachTestInOrderAndNoneFavoursAMotion) {
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    EXPECT_EQ(size_t(trust_table::kTerms[k].doubt), k);
    EXPECT_GE(trust_table::kTerms[k].weight, 0) << trust_table::kTerms[k].name;
  }
}

TEST(MotionConfidence, IsHighOnADriveThatIsRight) {
  Drive drive;
  const FrameConfidence trust = drive.go(good_evidence(), kStep, 100);
  EXPECT_GT(trust.p_right, 0.9);
  EXPECT_EQ(to_string(trust.reasons), "");
}

// Evidence as it usually is; good_evidence() is better.
FrameEvidence usual_evidence() {
  FrameEvidence e = good_evidence();
  e.residual_px = 0.7, e.pose_sigmas.fill(7e-4);
  return e;
}

TEST(MotionConfidence, IsLowWhenTheUnitOfTheMapHasFallen) {
  Drive drive;
  drive.go(usual_evidence(), kStep, 100);
  FrameEvidence fallen = usual_evidence();
  fallen.corners->change_10 = -std::log(0.15);
  fallen.corners->motion_error = 1 / 0.15 - 1, fallen.corners->motion_sigma = 0.2;
  fallen.moved_by_map = 0.03;
  const FrameConfidence trust = drive.go(fallen, 0.15 * kStep, 10);
  EXPECT_LT(trust.p_right, 0.5 * kDoubtfulBelow);
  EXPECT_FALSE(trust.reasons.empty());
}

// Adjustments have moved the keyframes: what is reported is not what was tracked.
TEST(MotionConfidence, IsLowWhereTheMapHasMovedUnderTheCameraAndSaysSo) {
  Drive drive;
  double before = drive.go(usual_evidence(), kStep, 100).p_right;
  FrameEvidence moved = usual_evidence();
  moved.residual_px = 1.2, moved.pose_sigmas.fill(2e-3);
  before = drive.go(moved, kStep, 20).p_right;
  for (const double share : {0.05, 0.2, 0.5, 1.0, 3.0}) {  // of the way
    moved.moved_by_map = share * 10 * kStep / kDepth;
    const FrameConfidence now = drive.go(moved);
    EXPECT_LT(now.p_right, before) << share;
    before = now.p_right;
  }
  EXPECT_LT(before, kDoubtfulBelow);
  EXPECT_EQ(to_string(drive.go(moved).reasons),
            "the map moved under the camera within 10 frames (by 160.0 % of the depth)");
}

// In light that moves corners follow shadows: alone they do not decide.
TEST(MotionConfidence, IsHighWhereTheCornersAloneHaveChanged) {
  Drive drive;
  drive.go(good_evidence(), kStep, 100);
  FrameEvidence fooled = good_evidence();
  fooled.corners->change_10 = -std::log(0.15);
  fooled.corners->motion_error = 1 / 0.15 - 1, fooled.corners->motion_sigma = 0.2;
  EXPECT_GT(drive.go(fooled, kStep, 10).p_right, kDoubtfulBelow);
}

// Its witnesses are taken away one after the other.
TEST(MotionConfidence, FallsSmoothlyAsThePoseBecomesLessCertain) {
  Drive drive;
  drive.go(good_evidence(), kStep, 60);
  FrameEvidence vaguer = good_evidence();
  double before = drive.go(good_evidence()).p_right;
  for (int i = 0; i < 160; ++i) {
    for (double& sigma : vaguer.pose_sigmas) sigma *= 1.04;
    if (i > 40) vaguer.corners.reset();
    const double now = drive.go(vaguer).p_right;
    EXPECT_LE(now, before + 1e-9) << i;
    EXPECT_GT(now, before - 0.06) << i;
    before = now;
  }
  EXPECT_LT(before, kDoubtfulBelow);
}

TEST(MotionConfidence, FallsSmoothlyAsTheCornersBecomeLessCertainAndGo) {
  Drive drive;
  FrameEvidence vaguer = good_evidence();
  const double sure = drive.go(vaguer, kStep, 60).p_right;
  double before = sure;
  for (int i = 0; i < 100; ++i) {
    vaguer.corners->motion_sigma *= 1.06, vaguer.corners->rotation_sigma_deg *= 1.06;
    const double now = drive.go(vaguer).p_right;
    EXPECT_LE(now, before + 1e-9) << i;
    EXPECT_GT(now, before - 0.06) << i;
    before = now;
  }
  vaguer.corners.reset();
  EXPECT_GT(drive.go(vaguer).p_right, kDoubtfulBelow) << "no corners do not speak against a motion";
}

// Corners share the mistake, so that nothing else shows it.
TEST(MotionConfidence, ATurnWithAWrongFocalLengthIsInDoubtAndTheStraightWayIsNot) {
  Drive drive;
  FrameEvidence wrong = good_evidence();
  wrong.focal_error = 0.25, wrong.focal_error_sigma = 0.03;
  EXPECT_GT(drive.go(wrong, kStep, 60).p_right, 0.9);
  drive.turn = 0.05;
  const FrameConfidence turning = drive.go(wrong, kStep, 12);
  EXPECT_LT(turning.p_right, kDoubtfulBelow);
  EXPECT_THAT(to_string(turning.reasons), HasSubstr("a focal length that the corners put 25 % off"));
  drive.turn = 0;
  EXPECT_GT(drive.go(wrong, kStep, 12).p_right, 0.9);
  drive.turn = 0.05, wrong.focal_error = 0.02;
  EXPECT_GT(drive.go(wrong, kStep, 12).p_right, 0.9) << "within what corners can show";
}

TEST(MotionConfidence, AFocalLengthThatMayBeRightDoesNotDecideAlone) {
  Drive drive;
  FrameEvidence early = good_evidence();
  early.focal_error = 0.08, early.focal_error_sigma = 0.04;
  drive.turn = 0.04;
  EXPECT_GT(drive.go(early, kStep, 60).p_right, kDoubtfulBelow);
}

// A step ahead of a hand over a desk, and a small part of the way of a car.
TEST(MotionConfidence, AZoomThatFeignsTheMotionIsDoubtedAndNamed) {
  const FrameEvidence e = good_evidence();
  const auto trust_at = [&](double step, double zoom, double sigma) {
    Drive drive;
    drive.go(e, step, 80);
    ConfidenceInput frame{e, drive.next(step)};
    frame.by_zoom = {zoom, std::abs(zoom), sigma};
    return drive.trust.add(frame);
  };
  constexpr double kHand = 0.02;  // a step, units
  const FrameConfidence zoomed = trust_at(kHand, -0.05, 0.01);
  EXPECT_LT(zoomed.p_right, kDoubtfulBelow);
  EXPECT_THAT(to_string(zoomed.reasons), HasSubstr("the images zoom by 5.0 % within 10 frames"));
  EXPECT_GT(trust_at(kStep, -0.05, 0.01).p_right, 0.95);
  EXPECT_GT(trust_at(kHand, 0.004, 0.008).p_right, kDoubtfulBelow) << "nothing that is certain";
  EXPECT_GT(trust_at(kHand, 0.01, 0.08).p_right, 0.9) << "what is not known speaks against no motion";
}

TEST(MotionConfidence, EdgesThatLieOffTheMapAreInDoubtEvenIfTheyCountAsInliers) {
  Drive drive;
  FrameEvidence fit = usual_evidence();
  fit.pose_sigmas.fill(0.03);
  FrameEvidence misfit = fit;
  misfit.residual_px = 4;
  const double right = drive.go(fit, kStep, 60).p_right;
  EXPECT_GT(drive.go(misfit).p_right, right - 0.05) << "one frame is no map";
  EXPECT_LT(drive.go(misfit, kStep, 20).p_right, right - 0.2);
  drive.go(fit, kStep, 20);
  EXPECT_NEAR(drive.go(fit).p_right, right, 1e-12) << "and it is over when they fit again";
}

// Edges and corners share what a rolling shutter does: they agree on a wrong translation.
TEST(MotionConfidence, ATranslationThatTheTurnHidesIsInDoubt) {
  Drive drive;
  drive.turn = 0.06;
  const FrameConfidence turning = drive.go(good_evidence(), 0.002 * kDepth, 60);
  EXPECT_GT(turning.doubts[size_t(ConsistencyTest::kTurn)], 0);
  drive.turn = 0;
  EXPECT_LT(drive.go(good_evidence(), 0.002 * kDepth, 12).doubts[size_t(ConsistencyTest::kTurn)], -4);
}

TEST(MotionConfidence, IsLowerWithoutAnyCrossCheck) {
  Drive with, without;
  const double high = with.go(good_evidence(), kStep, 50).p_right;
  FrameEvidence alone = good_evidence();
  alone.corners.reset();
  alone.pose_sigmas = FrameEvidence::unknown_sigmas();
  EXPECT_LT(without.go(alone, kStep, 50).p_right, std::min(high, kDoubtfulBelow))
      << "no corners and no information: nothing says that the motion is right";
}

TEST(MotionConfidence, DoesNotMeasureAStepAcrossAGapOrASegment) {
  Drive drive;
  drive.go(good_evidence(), kStep, 60);
  drive.history.interrupt();
  const double of_right_runs = trust_table::kTerms[size_t(ConsistencyTest::kStep)].usual;
  EXPECT_LE(drive.go(good_evidence(), 100).doubts[size_t(ConsistencyTest::kStep)], of_right_runs);
  drive.history.begin_map();
  EXPECT_LE(drive.go(good_evidence(), 100).doubts[size_t(ConsistencyTest::kStep)], of_right_runs);
}

// No gate: what the step adds grows with it.
TEST(MotionConfidence, TheLongerAStepTheLessItIsTrusted) {
  double before = 1, fall = 0;
  for (double times = 1; times < 500; times *= 1.2) {
    Drive drive;
    drive.go(good_evidence(), kStep, 60);
    const double now = drive.go(good_evidence(), times * kStep).p_right;
    EXPECT_LE(now, before) << times;
    fall = std::max(fall, before - now), before = now;
    EXPECT_TRUE(now > kDoubtfulBelow || times > 3) << times;
  }
  EXPECT_LT(before, 0.2);
  EXPECT_LT(fall, 0.15);
}

TEST(MotionConfidence, AGiantStepIsInDoubtAndNamed) {
  Drive drive;
  drive.go(good_evidence(), kStep, 60);
  const FrameConfidence giant = drive.go(good_evidence(), 400 * kStep);
  EXPECT_LT(giant.p_right, kDoubtfulBelow);
  EXPECT_THAT(to_string(giant.reasons), HasSubstr("steps unlike those before"));
}

TEST(MotionConfidence, ACameraThatHasStoodStillMayStartToMove) {
  Drive drive;
  drive.go(good_evidence(), 1e-6, 60);
  EXPECT_GT(drive.go(good_evidence(), 0.01 * kDepth).p_right, kDoubtfulBelow);
}

// What the edges confirm is no suspicion, and no measure of the steps to come.
TEST(MotionConfidence, ACameraThatIsKnownToStandIsNotInDoubtAndGoesOnAsItCame) {
  Drive drive;
  drive.go(good_evidence(), kStep, 60);
  FrameEvidence standing = good_evidence();
  standing.stands = true;
  for (int i = 0; i < 60; ++i) EXPECT_GT(drive.go(standing, 1e-4 * kStep).p_right, 0.9) << i;
  const FrameConfidence first = drive.go(good_evidence(), kStep);
  EXPECT_GT(first.p_right, 0.9);
  EXPECT_LT(drive.go(good_evidence(), 400 * kStep).p_right, kDoubtfulBelow)
      << "against the steps before the stop";
}

TEST(MotionConfidence, AStandstillThatNothingConfirmsIsAnUnusualStep) {
  for (const bool is_confirmed : {false, true}) {
    Drive drive;
    drive.go(good_evidence(), kStep, 60);
    FrameEvidence evidence = good_evidence();
    evidence.stands = is_confirmed;
    const double doubt = drive.go(evidence, 1e-4 * kStep, 10).doubts[size_t(ConsistencyTest::kStep)];
    EXPECT_EQ(doubt > 0.5, !is_confirmed) << doubt;
  }
}

TEST(MotionConfidence, IsTheSameForTheSameFrames) {
  Drive a, b;
  for (int i = 0; i < 30; ++i) {
    FrameEvidence e = good_evidence();
    e.inlier_share -= 0.01 * i;
    EXPECT_EQ(a.go(e).p_right, b.go(e).p_right);
  }
}

}  // namespace
}  // namespace edgevo
