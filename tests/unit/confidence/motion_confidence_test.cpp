// SPDX-License-Identifier: BSD-3-Clause
// The probability of a right motion: never higher for more doubt, not high without a witness, and on made
// runs high while all is well, low soon after the unit of the map has changed.
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
    for (int i = 0; i < frames; ++i) newest = trust.add({evidence, segment, next(step, evidence.stands)});
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
  int segment = 0;
  double turn = 0;  // radians a frame

 private:
  double z_ = 0, turn_ = 0;
};

TEST(PRight, NeverRisesWithADoubt) {
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    Inconsistencies doubts{};
    double before = p_right(doubts);
    for (doubts[k] = 0.1; doubts[k] <= 3; doubts[k] += 0.1) {
      const double p = p_right(doubts);
      EXPECT_LE(p, before) << trust_table::kTerms[k].name;
      before = p;
    }
  }
}

TEST(PRight, IsAProbability) {
  Inconsistencies all;
  all.fill(3);
  EXPECT_LT(p_right(all), kDoubtfulBelow);
  EXPECT_GE(p_right(all), 0);
  EXPECT_GT(p_right(Inconsistencies{}), kDoubtfulBelow);
  EXPECT_LE(p_right(Inconsistencies{}), 1);
}

TEST(TrustTable, HasATermForEachTestInOrderAndNoneFavoursAMotion) {
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    EXPECT_EQ(size_t(trust_table::kTerms[k].doubt), k);
    EXPECT_GE(trust_table::kTerms[k].weight, 0) << trust_table::kTerms[k].name;
  }
  for (size_t i = 1; i < trust_table::kKnots.size(); ++i) {
    EXPECT_GT(trust_table::kKnots[i].sum, trust_table::kKnots[i - 1].sum);
    EXPECT_LE(trust_table::kKnots[i].p_right, trust_table::kKnots[i - 1].p_right);
  }
}

TEST(MotionConfidence, IsHighOnADriveThatIsRight) {
  Drive drive;
  const FrameConfidence trust = drive.go(good_evidence(), kStep, 100);
  EXPECT_GT(trust.p_right, 0.9);
  EXPECT_EQ(to_string(trust.reasons), "");
}

TEST(MotionConfidence, IsLowWhenTheUnitOfTheMapHasFallen) {
  Drive drive;
  drive.go(good_evidence(), kStep, 100);
  FrameEvidence fallen = good_evidence();
  fallen.corners->change_10 = -std::log(0.4);
  fallen.corners->motion_error = 0.6, fallen.corners->motion_error_depths = 0.3;
  const FrameConfidence trust = drive.go(fallen, 0.4 * kStep, 10);
  EXPECT_LT(trust.p_right, kDoubtfulBelow);
  EXPECT_EQ(to_string(trust.reasons), "scale fell by 0.60 within 10 frames");
}

TEST(PRight, ContradictionsDecideAlone) {
  for (const auto& [doubt, value] :
       {std::pair(ConsistencyTest::kMotion, 1.6), std::pair(ConsistencyTest::kFocalLength, 1.0),
        std::pair(ConsistencyTest::kNoCrossCheck, 3.0)}) {
    Inconsistencies doubts{};
    doubts[size_t(doubt)] = value;
    EXPECT_LT(p_right(doubts), kDoubtfulBelow);
    doubts[size_t(doubt)] = 0.8 * value;
    EXPECT_EQ(p_right_limit(doubts), 1);
  }
}

// Corners share the mistake, so that nothing else shows it.
TEST(MotionConfidence, ATurnWithAWrongFocalLengthIsInDoubtAndTheStraightWayIsNot) {
  Drive drive;
  FrameEvidence wrong = good_evidence();
  wrong.focal_error = 0.25, wrong.focal_error_sigma = 0.06;
  EXPECT_GT(drive.go(wrong, kStep, 60).p_right, 0.9);
  drive.turn = 0.05;
  const FrameConfidence turning = drive.go(wrong, kStep, 12);
  EXPECT_LT(turning.p_right, kDoubtfulBelow);
  EXPECT_THAT(to_string(turning.reasons), HasSubstr("a focal length that the corners put 25 % off"));
  drive.turn = 0;
  EXPECT_GT(drive.go(wrong, kStep, 12).p_right, 0.9);
  drive.turn = 0.05, wrong.focal_error = 0.05;
  EXPECT_GT(drive.go(wrong, kStep, 12).p_right, 0.9) << "within what corners can show";
}

// Right cameras are up to 1.8 standard deviations off.
TEST(MotionConfidence, AFocalLengthThatMayBeRightDoesNotDecideAlone) {
  Drive drive;
  FrameEvidence early = good_evidence();
  early.focal_error = 0.12, early.focal_error_sigma = 0.065;
  drive.turn = 0.05;
  EXPECT_GT(drive.go(early, kStep, 60).p_right, kDoubtfulBelow);
}

TEST(MotionConfidence, EdgesThatLieOffTheMapAreInDoubtEvenIfTheyCountAsInliers) {
  Drive drive;
  FrameEvidence misfit = good_evidence();
  misfit.residual_px = 1.8;
  const double right = drive.go(good_evidence(), kStep, 60).p_right;
  EXPECT_GT(drive.go(misfit).p_right, 0.9) << "one frame is no map";
  EXPECT_LT(drive.go(misfit, kStep, 20).p_right, right - 0.1);
  drive.go(good_evidence(), kStep, 20);
  EXPECT_EQ(drive.go(good_evidence()).p_right, right) << "and it is over when they fit again";
}

// The corners' own path has no length yet.
TEST(MotionConfidence, TurnsOfAFirstMapHideATranslationUntilCornersAgree) {
  Drive unknown, agreed;
  FrameEvidence first = good_evidence();
  first.corners->motion_error_depths = first.corners->motion_error = first.corners->motion_sigma =
      CornerEvidence::kUnknown;
  unknown.turn = agreed.turn = 0.04;
  EXPECT_GT(unknown.go(first, 0.002 * kDepth, 12).doubts[size_t(ConsistencyTest::kTurn)], 1);
  FrameEvidence right = good_evidence();
  right.corners->motion_error_depths = 0.001;
  EXPECT_LT(agreed.go(right, 0.002 * kDepth, 20).doubts[size_t(ConsistencyTest::kTurn)], 0.1);
}

// Edges and corners share what a rolling shutter does: in single frames they agree on a wrong translation.
TEST(MotionConfidence, ATranslationThatTheTurnsOfTheRunHideIsInDoubt) {
  Drive drive;
  FrameEvidence shaken = good_evidence();
  shaken.corners->motion_error_depths = 0.04;
  drive.turn = 0.04;
  const FrameConfidence among_turns = drive.go(shaken, 0.002 * kDepth, 60);
  EXPECT_GT(among_turns.doubts[size_t(ConsistencyTest::kTurn)], 1.5);
  const FrameConfidence agreed = drive.go(good_evidence(), 0.002 * kDepth, 10);
  EXPECT_GT(agreed.doubts[size_t(ConsistencyTest::kTurn)], 1.5) << "agreement in one frame is no acquittal";
  EXPECT_GT(trust_table::kTerms[size_t(ConsistencyTest::kTurn)].weight, 0);
  drive.turn = 0;
  EXPECT_EQ(drive.go(good_evidence(), 0.002 * kDepth, 12).doubts[size_t(ConsistencyTest::kTurn)], 0);
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
  EXPECT_NEAR(drive.go(good_evidence(), 100).doubts[size_t(ConsistencyTest::kStep)], 0, 1e-9);
  drive.segment = 1, drive.history.begin_map();
  EXPECT_NEAR(drive.go(good_evidence(), 100).doubts[size_t(ConsistencyTest::kStep)], 0, 1e-9);
}

TEST(MotionConfidence, AStepOfMoreThanTenUsualOnesIsInDoubt) {
  Drive drive;
  drive.go(good_evidence(), kStep, 60);
  EXPECT_GT(drive.go(good_evidence(), 3 * kStep).p_right, kDoubtfulBelow);
  const FrameConfidence giant = drive.go(good_evidence(), 400 * kStep);
  EXPECT_LT(giant.p_right, kDoubtfulBelow);
  EXPECT_THAT(to_string(giant.reasons), HasSubstr("a step of 400 times the usual one"));
}

TEST(MotionConfidence, ACameraThatHasStoodStillMayStartToMove) {
  Drive drive;
  drive.go(good_evidence(), 1e-6, 60);
  EXPECT_GT(drive.go(good_evidence(), 0.01 * kDepth).p_right, kDoubtfulBelow);
}

TEST(MotionConfidence, NoStepOfMoreThanTenUsualOnesIsTracking) {
  for (const double usual : {kStep, 1e-6}) {
    Drive drive;
    drive.go(good_evidence(), usual, 60);
    const FrameConfidence small = drive.go(good_evidence(), 9.9 * usual),
                          giant = drive.go(good_evidence(), 10.1 * usual);
    EXPECT_FALSE(small.is_step_outlier);
    EXPECT_TRUE(giant.is_step_outlier);
    const FrameStatus status = frame_status({TrackingState::kTracking, {}}, giant);
    EXPECT_EQ(status.state, TrackingState::kDegraded);
    EXPECT_THAT(to_string(status.reasons), HasSubstr("a step of 10 times the usual one"));
  }
}

// A unit that is set back is no step in the map, but one in what the run reports.
TEST(MotionConfidence, AGiantStepOfTheReportedPosesIsNotTracking) {
  Drive drive;
  drive.go(good_evidence(), kStep, 60);
  const FrameEvidence evidence = good_evidence();
  const FrameConfidence small = drive.trust.add({evidence, 0, drive.next(), 9.9}),
                        giant = drive.trust.add({evidence, 0, drive.next(), 10.1});
  EXPECT_FALSE(small.is_step_outlier);
  EXPECT_TRUE(giant.is_step_outlier);
  EXPECT_GT(giant.p_right, kDoubtfulBelow);
  EXPECT_THAT(to_string(giant.reasons), HasSubstr("a step of 10 times the usual one"));
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
  EXPECT_FALSE(first.is_step_outlier);
  EXPECT_TRUE(drive.go(good_evidence(), 10.1 * kStep).is_step_outlier) << "against the steps before the stop";
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

// As many small steps as large ones: either may be taken for the usual one.
TEST(MotionConfidence, StepsOfACameraThatStandsByTurnsAreComparedWithTheSmallOnes) {
  Drive drive;
  for (int i = 0; i < 51; ++i) drive.go(good_evidence(), i % 2 ? 20 * kStep : kStep);
  EXPECT_TRUE(drive.go(good_evidence(), 15 * kStep).is_step_outlier);
}

TEST(MotionConfidence, IsTheSameForTheSameFrames) {
  Drive a, b;
  for (int i = 0; i < 30; ++i) {
    FrameEvidence e = good_evidence();
    e.inlier_share -= 0.01 * i;
    EXPECT_EQ(a.go(e).p_right, b.go(e).p_right);
  }
}

TEST(Status, IsDegradedInDoubtAndSaysWhy) {
  FrameConfidence doubtful;
  doubtful.p_right = kDoubtfulBelow - 1e-6, doubtful.reasons = {{ReasonKind::kTurn}};
  const FrameStatus degraded = frame_status({TrackingState::kTracking, {}}, doubtful);
  EXPECT_EQ(degraded.state, TrackingState::kDegraded);
  EXPECT_EQ(to_string(degraded.reasons), "a translation that the turn hides");
  EXPECT_EQ(to_string(frame_status({TrackingState::kDegraded, {{ReasonKind::kDiverged}}}, doubtful).reasons),
            "alignment diverged; a translation that the turn hides");
  EXPECT_EQ(to_string(frame_status({TrackingState::kLost, {{ReasonKind::kDiverged}}}, doubtful).reasons),
            "alignment diverged");
  FrameConfidence sure;
  sure.p_right = kDoubtfulBelow;
  EXPECT_EQ(frame_status({TrackingState::kTracking, {}}, sure).state, TrackingState::kTracking);
}

TEST(Covariance, GrowsWithDoubtToAHundredfoldAtMost) {
  EXPECT_EQ(covariance_factor(1), 1);
  EXPECT_EQ(covariance_factor(kDoubtfulBelow), 1);
  EXPECT_NEAR(covariance_factor(kDoubtfulBelow / 2), 4, 1e-9);
  EXPECT_EQ(covariance_factor(0), 100);
  EXPECT_EQ(covariance_factor(std::nan("")), 1);
}

}  // namespace
}  // namespace edgevo
