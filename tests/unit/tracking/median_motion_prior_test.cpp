// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/median_motion_prior.h"

#include <gtest/gtest.h>

#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/motion_history.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

constexpr int kKnown = 29;  // frames until the median step is known: nine in a row, then twenty

Timestamp time_at(double seconds) { return Timestamp::from_seconds(seconds); }

// Model and history of one camera.
struct Followed {
  MotionModel model;
  MotionHistory history;

  void follow(const SE3& T_cur_ref) {
    history.add({SE3(), model.motion_to(T_cur_ref), model.frames_since()});
    model.follow(T_cur_ref);
  }
  std::optional<MedianMotionPrior> prior() const {
    return MedianMotionPrior::of(model, history.median_step());
  }
  double sigmas_to(const SE3& T_cur_ref) const {
    return step_sigmas(model, history.median_step(), T_cur_ref);
  }
};

// A camera that approached the plane by 1 cm per frame, give or take 1 mm, and is at the reference now.
Followed approaching() {
  Followed m;
  std::vector<SE3> T{SE3()};
  for (int i = 0; i < kKnown + 10; ++i)
    T.push_back(SE3::exp(twist(0, 0, i % 2 == 0 ? 0.009 : 0.011, 0, 0, 0)) * T.back());
  const SE3 last = T.back().inverse();
  m.model.begin_frame(time_at(0));
  m.model.restart(SE3());
  m.model.change_reference(T.front() * last);  // the reference is where the last frame is
  for (size_t i = 1; i < T.size(); ++i) {
    m.model.begin_frame(time_at(0.1 * double(i)));
    m.follow(T[i] * last);
  }
  return m;
}

// ---- the median step against another one ----

const SE3 kMedian = SE3::exp(twist(0, 0, 0.01, 0, 0, 0)), kJump = SE3::exp(twist(0.1, 0, -0.2, 0, 0, 0));

struct Selection {
  bool was_called_for = false;
  PoseCandidate pose;
};

// Selects between `found`, where tracking first puts a frame taken at `truth`, and the median step.
Selection select_pose(const Followed& motion, const SE3& truth, const SE3& found) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto pyramid = scene.pyramid(truth.inverse());
  const AlignmentParams params;
  Selection selected;
  selected.pose.T_cur_ref = found;
  selected.pose.evidence = weigh_evidence(*pyramid, cloud, found, params);
  const auto prior = motion.prior();
  if (!prior || !prior->is_unusual(found) || !prior->is_apart(pyramid->finest().pinhole, cloud, found))
    return selected;
  selected.was_called_for = true;
  const SupportScorer scorer(StatusParams(), [&](const SE3& T) { return prior->likelihood(T); });
  const PoseCandidate near = align(*pyramid, cloud, prior->hypothesis(), params);
  if (scorer.score(near) > scorer.score(selected.pose)) selected.pose = near;
  return selected;
}

TEST(MedianMotionPrior, AnUnsupportedJumpIsRejected) {
  const Selection selected = select_pose(approaching(), kMedian, kJump);
  EXPECT_LT((selected.pose.T_cur_ref.translation() - kMedian.translation()).norm(), 0.005);
  EXPECT_GT(selected.pose.evidence.inlier_share, 0.8);
}

TEST(StepSigmas, AJumpIsManyOfThemAndAUsualStepFew) {
  Followed m = approaching();
  const SE3 across = SE3::exp(twist(0.0005, 0.0002, 0, 0, 0, 0));
  for (int i = 0; i < 40; ++i) {  // a spread on all axes
    m.model.begin_frame(time_at(4.1 + 0.1 * i));
    m.follow(kMedian * (i % 2 == 0 ? across : across.inverse()) * m.model.T_last_ref());
  }
  m.model.begin_frame(time_at(8.1));
  EXPECT_LT(m.sigmas_to(kMedian * m.model.T_last_ref()), 3);
  EXPECT_GT(m.sigmas_to(kJump * m.model.T_last_ref()), 50);
  m.model.begin_frame(time_at(100));
  EXPECT_TRUE(std::isnan(m.sigmas_to(kMedian * m.model.T_last_ref()))) << "over a gap";
  EXPECT_TRUE(std::isnan(Followed().sigmas_to(SE3()))) << "nothing is known yet";
}

TEST(MedianMotionPrior, ASupportedJumpIsKept) {
  const Selection selected = select_pose(approaching(), kJump, kJump);
  EXPECT_TRUE(selected.was_called_for);
  EXPECT_EQ((selected.pose.T_cur_ref.translation() - kJump.translation()).norm(), 0);
}

// The source skipped frames: the median step is that of one frame.
TEST(MedianMotionPrior, DoesNotExistOverAGap) {
  Followed m = approaching();
  m.model.begin_frame(time_at(100));
  EXPECT_FALSE(m.prior());
}

// Unusual for such an even motion, but within a pixel of the median step: the image cannot distinguish the
// two.
TEST(MedianMotionPrior, IgnoresSmallDifferences) {
  const SE3 truth = SE3::exp(twist(0, 0, 0.02, 0, 0, 0));
  ASSERT_TRUE(approaching().prior());
  EXPECT_TRUE(approaching().prior()->is_unusual(truth));
  EXPECT_FALSE(select_pose(approaching(), truth, truth).was_called_for);
}

// A hand-held camera moves to and fro: the prior does not apply.
TEST(MedianMotionPrior, DoesNotExistForAnUnsteadyCamera) {
  Followed swaying;
  swaying.model.restart(SE3());
  for (int i = 0; i < kKnown + 10; ++i) {
    swaying.model.begin_frame(time_at(0.1 * i));
    swaying.follow(SE3::exp(twist(0, 0, i % 2 == 0 ? 0.01 : 0, 0, 0, 0)));
  }
  ASSERT_TRUE(swaying.history.median_step());
  EXPECT_FALSE(swaying.prior());
}

}  // namespace
}  // namespace edgevo
