// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/median_motion.h"

#include <gtest/gtest.h>

#include "edgevo/confidence/frame_status.h"
#include "edgevo/tracking/motion_model.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

constexpr int kKnown = 29;  // frames until the median step is known: nine in a row, then twenty

// Steps along z of 0.1 that differ from it by 0.01, alternately.
Eigen::Vector3d swaying(int i) { return {0, 0, i % 2 == 0 ? 0.11 : 0.09}; }

MedianMotion after(int frames) {
  MedianMotion m;
  for (int i = 0; i < frames; ++i) m.follow(swaying(i), false);
  return m;
}

TEST(MedianMotion, IsKnownAfterSomeFrames) {
  EXPECT_FALSE(after(kKnown - 1).median_step());
  const auto step = after(kKnown + 40).median_step();
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->translation.z(), 0.1, 0.011);
  EXPECT_EQ(step->translation.x(), 0);
  EXPECT_GT(step->sigma.z(), 0.005);
  EXPECT_LT(step->sigma.z(), 0.025);
}

TEST(MedianMotion, OneJumpDoesNotMoveTheMedian) {
  MedianMotion m = after(kKnown + 40);
  const MedianMotion::Step before = *m.median_step();
  m.follow({5, 5, 5}, false);
  const MedianMotion::Step now = *m.median_step();
  EXPECT_LT((now.translation - before.translation).norm(), 0.021);
}

// Steps that the prior itself decided on do not reduce the standard deviation.
TEST(MedianMotion, HeldStepsDoNotChangeTheSigma) {
  MedianMotion m = after(kKnown + 40);
  const double before = m.median_step()->sigma.z();
  for (int i = 0; i < 100; ++i) m.follow(m.median_step()->translation, true);
  EXPECT_EQ(m.median_step()->sigma.z(), before);
}

TEST(MedianMotion, AGapInterrupts) {
  MedianMotion m = after(kKnown + 40);
  m.interrupt();
  EXPECT_FALSE(m.median_step());
  for (int i = 0; i < 9; ++i) m.follow(swaying(i), false);
  EXPECT_TRUE(m.median_step());  // the standard deviations have been kept
}

Timestamp time_at(double seconds) { return Timestamp::from_seconds(seconds); }

// A camera that approached the plane by 1 cm per frame, give or take 1 mm, and is at the reference now.
MotionModel approaching() {
  MotionModel m;
  std::vector<SE3> T{SE3()};
  for (int i = 0; i < kKnown + 10; ++i)
    T.push_back(SE3::exp(twist(0, 0, i % 2 == 0 ? 0.009 : 0.011, 0, 0, 0)) * T.back());
  const SE3 last = T.back().inverse();
  m.begin_frame(time_at(0));
  m.restart(SE3());
  m.change_reference(T.front() * last);  // the reference is where the last frame is
  for (size_t i = 1; i < T.size(); ++i) {
    m.begin_frame(time_at(0.1 * double(i)));
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
Selection select_pose(const MotionModel& motion, const SE3& truth, const SE3& found) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto pyramid = scene.pyramid(truth.inverse());
  const AlignmentParams params;
  Selection selected;
  selected.pose.T_cur_ref = found;
  selected.pose.evidence = weigh_evidence(*pyramid, cloud, found, params);
  const auto prior = MedianMotionPrior::of(motion);
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
  MotionModel m = approaching();
  const SE3 across = SE3::exp(twist(0.0005, 0.0002, 0, 0, 0, 0));
  for (int i = 0; i < 40; ++i) {  // a spread on all axes
    m.begin_frame(time_at(4.1 + 0.1 * i));
    m.follow(kMedian * (i % 2 == 0 ? across : across.inverse()) * m.T_last_ref());
  }
  m.begin_frame(time_at(8.1));
  EXPECT_LT(step_sigmas(m, kMedian * m.T_last_ref()), 3);
  EXPECT_GT(step_sigmas(m, kJump * m.T_last_ref()), 50);
  m.begin_frame(time_at(100));
  EXPECT_TRUE(std::isnan(step_sigmas(m, kMedian * m.T_last_ref()))) << "over a gap";
  EXPECT_TRUE(std::isnan(step_sigmas(MotionModel(), SE3()))) << "nothing is known yet";
}

TEST(MedianMotionPrior, ASupportedJumpIsKept) {
  const Selection selected = select_pose(approaching(), kJump, kJump);
  EXPECT_TRUE(selected.was_called_for);
  EXPECT_EQ((selected.pose.T_cur_ref.translation() - kJump.translation()).norm(), 0);
}

// The source skipped frames: the median step is that of one frame.
TEST(MedianMotionPrior, DoesNotExistOverAGap) {
  MotionModel m = approaching();
  m.begin_frame(time_at(100));
  EXPECT_FALSE(MedianMotionPrior::of(m));
}

// Unusual for such an even motion, but within a pixel of the median step: the image cannot distinguish the
// two.
TEST(MedianMotionPrior, IgnoresSmallDifferences) {
  const SE3 truth = SE3::exp(twist(0, 0, 0.02, 0, 0, 0));
  ASSERT_TRUE(MedianMotionPrior::of(approaching()));
  EXPECT_TRUE(MedianMotionPrior::of(approaching())->is_unusual(truth));
  EXPECT_FALSE(select_pose(approaching(), truth, truth).was_called_for);
}

// A hand-held camera moves to and fro: the prior does not apply.
TEST(MedianMotionPrior, DoesNotExistForAnUnsteadyCamera) {
  MotionModel swaying;
  swaying.restart(SE3());
  for (int i = 0; i < kKnown + 10; ++i) {
    swaying.begin_frame(time_at(0.1 * i));
    swaying.follow(SE3::exp(twist(0, 0, i % 2 == 0 ? 0.01 : 0, 0, 0, 0)));
  }
  ASSERT_TRUE(swaying.median_motion().median_step());
  EXPECT_FALSE(MedianMotionPrior::of(swaying));
}

}  // namespace
}  // namespace edgevo
