// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/frame_status.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <regex>

#include "edgevo/confidence/collect_evidence.h"
#include "edgevo/core/input_file.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

const StatusParams kParams;
const SE3 kBroken(Eigen::Quaterniond::Identity(), Eigen::Vector3d(std::nan(""), 0, 0));

// A frame without a fault.
FrameEvidence good_frame() {
  FrameEvidence e;
  e.visible_points = 1000;
  e.matched_points = 900;
  e.inlier_share = 0.9;
  e.residual_px = 0.4;
  e.pose_sigmas.fill(0.001);
  return e;
}

// ---- the table of the status ----

struct Row {
  const char* name;
  void (*change)(FrameEvidence*);
  TrackingState state;
  const char* reason;
};

const Row kTable[] = {
    {"good", [](FrameEvidence*) {}, TrackingState::kTracking, ""},
    {"diverged", [](FrameEvidence* e) { e->diverged = true; }, TrackingState::kLost, "alignment diverged"},
    {"not_tracked", [](FrameEvidence* e) { *e = FrameEvidence(); }, TrackingState::kLost,
     "only 0 map points in view, 60 are needed"},
    {"few_points", [](FrameEvidence* e) { e->visible_points = 59; }, TrackingState::kLost,
     "only 59 map points in view, 60 are needed"},
    {"enough_points", [](FrameEvidence* e) { e->visible_points = 60; }, TrackingState::kTracking, ""},
    {"unsupported", [](FrameEvidence* e) { e->inlier_share = 0.1499; }, TrackingState::kLost,
     "inlier share 0.15 is below 0.15"},
    {"just_supported", [](FrameEvidence* e) { e->inlier_share = 0.15; }, TrackingState::kDegraded,
     "inlier share 0.15 is below 0.40"},
    {"weak", [](FrameEvidence* e) { e->inlier_share = 0.394; }, TrackingState::kDegraded,
     "inlier share 0.39 is below 0.40"},
    {"just_good", [](FrameEvidence* e) { e->inlier_share = 0.4; }, TrackingState::kTracking, ""},
    {"of_unknown_covariance", [](FrameEvidence* e) { e->pose_sigmas = FrameEvidence::unknown_sigmas(); },
     TrackingState::kTracking, ""},  // that is for p_right to say
    {"diverged_with_few_points", [](FrameEvidence* e) { e->diverged = true, e->visible_points = 1; },
     TrackingState::kLost, "alignment diverged"},
    {"few_points_without_support", [](FrameEvidence* e) { e->visible_points = 1, e->inlier_share = 0; },
     TrackingState::kLost, "only 1 map points in view, 60 are needed"},
};

class FrameStatusTable : public ::testing::TestWithParam<Row> {};

TEST_P(FrameStatusTable, GivesStatusAndReason) {
  FrameEvidence evidence = good_frame();
  GetParam().change(&evidence);
  const FrameStatus status = frame_status(evidence, kParams);
  EXPECT_EQ(status.state, GetParam().state);
  EXPECT_EQ(to_string(status.reasons), GetParam().reason);
}

INSTANTIATE_TEST_SUITE_P(Evidence, FrameStatusTable, ::testing::ValuesIn(kTable),
                         [](const auto& row) { return row.param.name; });

TEST(FrameStatus, FollowsItsParameters) {
  StatusParams strict;
  strict.lost_share = 0.5, strict.degraded_share = 0.95, strict.min_visible = 1000;
  EXPECT_EQ(to_string(frame_status(good_frame(), strict).reasons), "inlier share 0.90 is below 0.95");
  strict.degraded_share = 0.9;
  EXPECT_EQ(frame_status(good_frame(), strict).state, TrackingState::kTracking);
  strict.min_visible = 1001;
  EXPECT_EQ(frame_status(good_frame(), strict).state, TrackingState::kLost);
}

TEST(FrameStatus, AHeldPoseNeedsNoPointsInView) {
  StatusParams strict = kParams;
  strict.min_visible = 1001;
  EXPECT_EQ(frame_status(good_frame(), strict).state, TrackingState::kLost);
  EXPECT_EQ(status_at_zero_velocity(good_frame(), strict).state, TrackingState::kTracking);
  strict.degraded_share = 0.95;
  EXPECT_EQ(status_at_zero_velocity(good_frame(), strict).state, TrackingState::kDegraded);
}

// ---- the image and the map ----

TEST(Evidence, AnImageNeedsAsManyEdgePixelsAsAPosePoints) {
  EXPECT_FALSE(shows_edges(59, kParams));
  EXPECT_TRUE(shows_edges(60, kParams));
}

TEST(Evidence, TheMapIsOutOfViewWithASmallPartOfIt) {
  FrameEvidence e = good_frame();
  e.view_share = 0.149;
  EXPECT_TRUE(is_out_of_view(e, kParams));
  e.view_share = 0.15;
  EXPECT_FALSE(is_out_of_view(e, kParams)) << "bad light";
  EXPECT_FALSE(is_out_of_view(FrameEvidence(), kParams)) << "not tracked";
}

TEST(Evidence, AFrameIsExplainedByMatches) {
  FrameEvidence e = good_frame();
  e.matched_points = 700;
  EXPECT_TRUE(is_explained(e));
  e.matched_points = 699;
  EXPECT_FALSE(is_explained(e));
  EXPECT_FALSE(is_explained(FrameEvidence())) << "not tracked";
}

TEST(Evidence, IsThatOfThePose) {
  TrackResult pose;
  pose.stats.visible = 100, pose.stats.inliers = 80, pose.stats.residual_px = 0.3;
  pose.evidence = {90, 0.7};
  pose.sigmas << 1, 2, 3, 4, 5, 6;
  Reference reference;
  reference.known_points = 150, reference.wanted_points = 200, reference.view_share = 0.4;
  FrameEvidence e;
  add_pose(pose, reference, &e);
  EXPECT_EQ(e.visible_points, 100);
  EXPECT_EQ(e.matched_points, 80);
  EXPECT_EQ(e.inlier_share, 0.7);
  EXPECT_EQ(e.residual_px, 0.3);
  EXPECT_EQ(e.pose_sigmas[5], 6);
  EXPECT_EQ(e.known_points, 150);
  EXPECT_EQ(e.lacking_share, 0.25);
  EXPECT_EQ(e.view_share, 0.4);
  EXPECT_FALSE(e.diverged);
  pose.T_cur_ref = kBroken;
  FrameEvidence broken;
  add_pose(pose, reference, &broken);
  EXPECT_TRUE(broken.diverged);
  EXPECT_TRUE(std::isnan(broken.pose_sigmas[5]));
}

// ---- the support of a pose, and the score ----

PoseCandidate candidate(double share, const SE3& T_cur_ref = SE3(), double weight = 1000) {
  PoseCandidate c;
  c.T_cur_ref = T_cur_ref;
  c.stats.visible = 1000;
  c.evidence = {weight, share};
  return c;
}

TEST(Classify, ReportsTheFirstFailedCriterion) {
  const auto support = [&](const PoseCandidate& pose) { return classify(evidence_of(pose), kParams); };
  EXPECT_EQ(support(candidate(kParams.degraded_share)), PoseSupport::kGood);
  EXPECT_EQ(support(candidate(0.99 * kParams.degraded_share)), PoseSupport::kWeak);
  EXPECT_EQ(support(candidate(kParams.lost_share)), PoseSupport::kWeak);
  EXPECT_EQ(support(candidate(0.99 * kParams.lost_share)), PoseSupport::kUnsupported);
  PoseCandidate pose = candidate(0.9);
  pose.stats.visible = kParams.min_visible;
  EXPECT_EQ(support(pose), PoseSupport::kGood);
  pose.stats.visible = kParams.min_visible - 1;
  EXPECT_EQ(support(pose), PoseSupport::kFewPoints);
  pose.T_cur_ref = kBroken;
  EXPECT_EQ(support(pose), PoseSupport::kDiverged);
}

TEST(Classify, OnlyWeakAndGoodPosesAreNotLost) {
  EXPECT_TRUE(is_lost(PoseSupport::kDiverged));
  EXPECT_TRUE(is_lost(PoseSupport::kFewPoints));
  EXPECT_TRUE(is_lost(PoseSupport::kUnsupported));
  EXPECT_FALSE(is_lost(PoseSupport::kWeak));
  EXPECT_FALSE(is_lost(PoseSupport::kGood));
}

TEST(SupportScorer, TheBetterSupportedPoseWins) {
  const SupportScorer scorer(kParams);
  EXPECT_GT(scorer.score(candidate(0.9)), scorer.score(candidate(0.8)));
  EXPECT_LT(scorer.score(candidate(0.5 * kParams.lost_share)), 0);
  EXPECT_TRUE(scorer.fits(candidate(kParams.degraded_share)));
  EXPECT_FALSE(scorer.fits(candidate(0.99 * kParams.degraded_share)));
  EXPECT_TRUE(scorer.is_lost(candidate(0.99 * kParams.lost_share)));
}

// A turn of eleven degrees in one frame of a drive: the right pose keeps few points in view, a wrong one that
// hardly rotates keeps three times as many and matches more edges by chance.
TEST(SupportScorer, ALargerShareOfFewPointsOutweighsChanceAmongMany) {
  const SupportScorer scorer(kParams);
  EXPECT_GT(scorer.score(candidate(0.299, SE3(), 65)), scorer.score(candidate(0.124, SE3(), 186)));
}

TEST(SupportScorer, AtEqualSharesThePoseWithMorePointsWins) {
  const SupportScorer scorer(kParams);
  EXPECT_GT(scorer.score(candidate(0.6, SE3(), 300)), scorer.score(candidate(0.6, SE3(), 200)));
  EXPECT_GT(scorer.score(candidate(0.6, SE3(), 200)), scorer.score(candidate(0.5, SE3(), 200)));
}

TEST(SupportScorer, AnUnlikelyMotionNeedsMoreSupport) {
  const SupportScorer scorer(kParams, [](const SE3& T) { return T.translation().norm() > 0.01 ? 0.5 : 1.0; });
  const SE3 far = SE3::exp(twist(1, 0, 0, 0, 0, 0));
  EXPECT_LT(scorer.score(candidate(0.9, far)), scorer.score(candidate(0.8)));
  EXPECT_GT(scorer.score(candidate(0.9, far)), scorer.score(candidate(0.4)));
  EXPECT_EQ(scorer.score(candidate(0.1, far)), scorer.score(candidate(0.1)))
      << "an unlikely pose must not gain below 0";
}

TEST(SupportScorer, APoseThatLeftItsPriorNeverWins) {
  const SupportScorer scorer(kParams, [](const SE3& T) { return T.translation().norm() > 0.01 ? 0.5 : 1.0; });
  PoseCandidate held = candidate(0.95, SE3::exp(twist(1, 0, 0, 0, 0, 0)));
  EXPECT_GT(scorer.score(held), scorer.score(candidate(0.4)));
  held.has_prior = true;
  EXPECT_LT(scorer.score(held), scorer.score(candidate(0.01)));
  held.T_cur_ref = SE3();
  EXPECT_GT(scorer.score(held), scorer.score(candidate(0.9))) << "it kept to its prior";
}

TEST(SupportScorer, APoseThatIsNotFiniteNeverWins) {
  const SupportScorer scorer(kParams);
  EXPECT_LT(scorer.score(candidate(0.9, kBroken)), scorer.score(candidate(0, SE3())));
  EXPECT_TRUE(scorer.is_lost(candidate(0.9, kBroken)));
}

// ---- one place ----

TEST(StatusParams, AreReadInOneFileOnly) {
  const std::filesystem::path root = EDGEVO_SOURCE_DIR;
  const std::regex threshold("\\b(lost_share|degraded_share|min_visible|away_view_share)\\b");
  std::vector<std::string> readers;
  for (const char* folder : {"modules", "app"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      if (std::regex_search(read_file(entry.path().string(), ""), threshold))
        readers.push_back(entry.path().filename().string());
    }
  EXPECT_THAT(readers, ::testing::UnorderedElementsAre("frame_status.cpp",
                                                       "frame_status.h",     // names them in comments
                                                       "status_params.h"));  // declares them
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

TEST(Covariance, GrowsWithDoubtSmoothlyToAHundredfoldAtMost) {
  EXPECT_EQ(covariance_factor(1), 1);
  EXPECT_EQ(covariance_factor(std::nan("")), 1) << "unknown";
  EXPECT_NEAR(covariance_factor(0.5), 2, 1e-9);
  EXPECT_NEAR(covariance_factor(0), 100, 1e-9);
}

}  // namespace
}  // namespace edgevo
