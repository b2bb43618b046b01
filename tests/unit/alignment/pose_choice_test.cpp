// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/pose_choice.h"

#include <gmock/gmock.h>

#include "edgevo/alignment/edge_alignment.h"
#include "support/inlier_scorer.h"
#include "support/plane_scene.h"
#include "support/pose_matchers.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

const SE3 kTruth = SE3::exp(twist(0.05, 0, 0, 0, 0.01, 0)), kWrong = SE3::exp(twist(0, 0, 0, 0, 0.9, 0));

// Proposers that count how often they are called.
class ChoosePose : public ::testing::Test {
 protected:
  Proposer proposer(ProposerKind kind, const std::vector<SE3>& starts, bool called, int* made) {
    return {kind, [called](const PoseCandidate&) { return called; },
            [starts, made] {
              ++*made;
              std::vector<PoseHypothesis> hypotheses;
              for (const SE3& start : starts) hypotheses.push_back({start});
              return hypotheses;
            }};
  }
  PoseChoice among(const std::vector<Proposer>& proposers) {
    return choose(proposers, *scene.pyramid(kTruth.inverse()), scene.cloud(SE3()), scorer, params);
  }

  test::PlaneScene scene;
  AlignmentParams params;
  test::InlierScorer scorer;
  int first = 0, second = 0;
};

TEST_F(ChoosePose, AProposerThatIsNotNeededIsNotCalled) {
  const PoseChoice c = among({proposer(ProposerKind::kStarts, {SE3(), kWrong}, false, &first),
                              proposer(ProposerKind::kCorners, {kWrong}, false, &second)});
  EXPECT_EQ(c.hypotheses_tried, 1);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 0);
  EXPECT_EQ(c.kind, ProposerKind::kStarts);
  EXPECT_TRUE(scorer.fits(c.pose));
}

TEST_F(ChoosePose, ABetterHypothesisWins) {
  const PoseChoice c = among({proposer(ProposerKind::kStarts, {kWrong}, true, &first),
                              proposer(ProposerKind::kCorners, {kWrong, SE3()}, true, &second)});
  EXPECT_EQ(c.hypotheses_tried, 3);
  EXPECT_EQ(c.kind, ProposerKind::kCorners);
  EXPECT_LT((c.pose.T_cur_ref.translation() - kTruth.translation()).norm(), 0.01);
}

TEST_F(ChoosePose, AWorseHypothesisDoesNotWin) {
  const PoseChoice c = among({proposer(ProposerKind::kStarts, {SE3()}, true, &first),
                              proposer(ProposerKind::kCorners, {kWrong}, true, &second)});
  EXPECT_EQ(c.hypotheses_tried, 2);
  EXPECT_EQ(c.kind, ProposerKind::kStarts);
  EXPECT_LT((c.pose.T_cur_ref.translation() - kTruth.translation()).norm(), 0.01);
}

// A tight prior keeps the translation at its expected value, a wide one leaves it to the image.
TEST(Align, APriorHoldsTheTranslationAsFarAsItsSigmaAllows) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.02, 0, 0.05, 0, 0, 0)),
            T_expected = SE3::exp(twist(0.02, 0, 0.01, 0, 0, 0));
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto pyramid = scene.pyramid(T_cur_ref.inverse());
  const auto error = [&](double sigma, const SE3& T) {
    const PoseHypothesis near{T_expected, PoseHypothesis::Refinement::kEdges,
                              Eigen::Vector3d::Constant(sigma)};
    const PoseCandidate r = align(*pyramid, cloud, near, AlignmentParams());
    EXPECT_TRUE(test::InlierScorer().fits(r));
    return (r.T_cur_ref.translation() - T.translation()).norm();
  };
  EXPECT_LT(error(1e-5, T_expected), 0.003);
  EXPECT_LT(error(10, T_cur_ref), 0.01);
}

// Rotation and direction are known, the length is wrong by half: the edges find it.
TEST(Align, AlongAKnownDirectionTheEdgesFindTheLength) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.25, 0.05, 0.3, 0.02, -0.03, 0.01));
  for (const double length : {0.55, 1.0, 1.9}) {
    const SE3 guess(T_cur_ref.rotation(), length * T_cur_ref.translation());
    const PoseHypothesis along{guess, PoseHypothesis::Refinement::kLengthThenEdges};
    const PoseCandidate r =
        align(*scene.pyramid(T_cur_ref.inverse()), scene.cloud(SE3()), along, AlignmentParams());
    EXPECT_TRUE(test::InlierScorer().fits(r));
    EXPECT_THAT(r.T_cur_ref,
                test::SE3Near(T_cur_ref, 0.02 * T_cur_ref.translation().norm(), 0.1 * M_PI / 180))
        << length;
  }
}

// A map that is bent pulls the pose away from what corners know better: the length alone follows the edges.
TEST(Align, AKnownRotationAndDirectionAreKeptWhereOnlyTheLengthIsSearched) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.25, 0.05, 0.3, 0.02, -0.03, 0.01));
  const auto pyramid = scene.pyramid(T_cur_ref.inverse());
  const auto found = [&](double length, PoseHypothesis::Refinement refinement) {
    const SE3 guess(T_cur_ref.rotation(), length * T_cur_ref.translation());
    const SE3 T = align(*pyramid, scene.cloud(SE3()), {guess, refinement}, AlignmentParams()).T_cur_ref;
    EXPECT_LT((T * guess.inverse()).angle(), 1e-9);
    EXPECT_LT(T.translation().normalized().cross(guess.translation().normalized()).norm(), 1e-9);
    return T.translation().norm() / T_cur_ref.translation().norm();
  };
  for (const double length : {0.55, 1.0, 1.9})
    EXPECT_NEAR(found(length, PoseHypothesis::Refinement::kLength), 1, 0.03) << length;
  EXPECT_NEAR(found(1.08, PoseHypothesis::Refinement::kNearLength), 1, 0.03);
  EXPECT_GT(found(1.9, PoseHypothesis::Refinement::kNearLength), 1.5) << "not beyond an eighth";
}

// The gray values of the coarse levels belong to another view, as those of shadows and glare do; the edges
// are those of the scene.
TEST(Align, EdgesOverruleMisledGrayLevels) {
  const test::PlaneScene scene;
  const SE3 T_cur_ref = SE3::exp(twist(0.05, 0, 0.05, 0, 0.01, 0)),
            elsewhere = SE3::exp(twist(0.4, 0, 0.05, 0, 0.04, 0));
  const auto frame = std::const_pointer_cast<FramePyramid>(scene.pyramid(T_cur_ref.inverse()));
  const auto misled = std::const_pointer_cast<FramePyramid>(scene.pyramid(elsewhere.inverse()));
  for (size_t level = 1; level < frame->levels.size(); ++level)
    std::swap(frame->levels[level].gray, misled->levels[level].gray);
  const FramePyramid& current = *frame;
  const ReferenceCloud cloud = scene.cloud(SE3());
  SE3 by_patches = T_cur_ref;
  align_patches(current, cloud, int(current.levels.size()) - 1, 1, &by_patches);
  for (int level : {1, 0}) align_edges(current, cloud, level, AlignmentParams(), &by_patches);
  ASSERT_GT((by_patches.translation() - T_cur_ref.translation()).norm(), 0.1)
      << "the gray levels do not mislead";
  const auto error = [&](const AlignmentParams& params) {
    return (align(current, cloud, {T_cur_ref}, params).T_cur_ref.translation() - T_cur_ref.translation())
        .norm();
  };
  AlignmentParams unverified;
  unverified.verify_patch_start = false;
  EXPECT_LT(error(AlignmentParams()), 0.01);
  EXPECT_GT(error(unverified), 0.1);
}

}  // namespace
}  // namespace edgevo
