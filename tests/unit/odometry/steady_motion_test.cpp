#include "steady_motion.h"

#include <gtest/gtest.h>

#include "motion_model.h"
#include "support/plane_scene.h"
#include "support/twist.h"

namespace edgevo {
namespace {

using test::twist;

constexpr int kKnown = 29;  // frames until a usual step is known: nine in a row, then twenty

// Steps along z of 0.1 that differ by 0.01 from it, alternately.
Eigen::Vector3d swaying(int i) { return {0, 0, i % 2 == 0 ? 0.11 : 0.09}; }

SteadyMotion after(int frames) {
  SteadyMotion m;
  for (int i = 0; i < frames; ++i) m.follow(swaying(i), false);
  return m;
}

TEST(SteadyMotion, IsKnownAfterSomeFrames) {
  EXPECT_FALSE(after(kKnown - 1).usual());
  const auto usual = after(kKnown + 40).usual();
  ASSERT_TRUE(usual);
  EXPECT_NEAR(usual->translation.z(), 0.1, 0.011);
  EXPECT_EQ(usual->translation.x(), 0);
  EXPECT_GT(usual->deviation.z(), 0.005);
  EXPECT_LT(usual->deviation.z(), 0.025);
}

TEST(SteadyMotion, OneJumpDoesNotMoveTheUsualStep) {
  SteadyMotion m = after(kKnown + 40);
  const SteadyMotion::Step before = *m.usual();
  m.follow({5, 5, 5}, false);
  const SteadyMotion::Step now = *m.usual();
  EXPECT_LT((now.translation - before.translation).norm(), 0.021);
}

// Steps that the expectation itself decided on do not make the camera look ever steadier.
TEST(SteadyMotion, HeldStepsSayNothingOfDeviations) {
  SteadyMotion m = after(kKnown + 40);
  const double before = m.usual()->deviation.z();
  for (int i = 0; i < 100; ++i) m.follow(m.usual()->translation, true);
  EXPECT_EQ(m.usual()->deviation.z(), before);
}

TEST(SteadyMotion, AGapInterrupts) {
  SteadyMotion m = after(kKnown + 40);
  m.interrupt();
  EXPECT_FALSE(m.usual());
  for (int i = 0; i < 9; ++i) m.follow(swaying(i), false);
  EXPECT_TRUE(m.usual());  // the deviations have stayed
}

Timestamp time_at(double seconds) { return Timestamp::from_seconds(seconds); }

// A camera that has come towards the plane by 1 cm a frame, give or take 1 mm, and stands at the reference
// now.
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

// ---- the usual step, judged beside another one ----

const SE3 kUsual = SE3::exp(twist(0, 0, 0.01, 0, 0, 0)), kJump = SE3::exp(twist(0.1, 0, -0.2, 0, 0, 0));

struct Judged {
  bool was_called_for = false;
  PoseCandidate pose;
};

// A frame taken at `truth`, which tracking takes to be at `found` at first.
Judged judge_beside_usual(const MotionModel& motion, const SE3& truth, const SE3& found) {
  const test::PlaneScene scene;
  const ReferenceCloud cloud = scene.cloud(SE3());
  const auto pyramid = scene.pyramid(truth.inverse());
  const AlignmentParams params;
  Judged judged;
  judged.pose.T_cur_ref = found;
  judged.pose.evidence = weigh_evidence(*pyramid, cloud, found, params);
  const auto usual = UsualStep::of(motion);
  if (!usual || !usual->is_unusual(found) || !usual->is_apart(pyramid->finest().pinhole, cloud, found))
    return judged;
  judged.was_called_for = true;
  const PoseJudge judge(params, [&](const SE3& T) { return usual->likelihood(T); });
  const PoseCandidate near = align(*pyramid, cloud, usual->hypothesis(), params);
  if (judge.score(near) > judge.score(judged.pose)) judged.pose = near;
  return judged;
}

TEST(UsualStep, AJumpThatTheImageDoesNotSupportIsTakenBack) {
  const Judged judged = judge_beside_usual(approaching(), kUsual, kJump);
  EXPECT_LT((judged.pose.T_cur_ref.translation() - kUsual.translation()).norm(), 0.005);
  EXPECT_GT(judged.pose.evidence.inlier_share, 0.8);
}

TEST(UsualStep, AJumpThatTheImageShowsStays) {
  const Judged judged = judge_beside_usual(approaching(), kJump, kJump);
  EXPECT_TRUE(judged.was_called_for);
  EXPECT_EQ((judged.pose.T_cur_ref.translation() - kJump.translation()).norm(), 0);
}

// The source left frames out: the usual step is that of one frame.
TEST(UsualStep, ThereIsNoneOverAGap) {
  MotionModel m = approaching();
  m.begin_frame(time_at(100));
  EXPECT_FALSE(UsualStep::of(m));
}

// Unusual for a camera so steady, but within a pixel of the usual step: both poses are the same to the image.
TEST(UsualStep, LeavesSmallDifferencesAlone) {
  const SE3 truth = SE3::exp(twist(0, 0, 0.02, 0, 0, 0));
  ASSERT_TRUE(UsualStep::of(approaching()));
  EXPECT_TRUE(UsualStep::of(approaching())->is_unusual(truth));
  EXPECT_FALSE(judge_beside_usual(approaching(), truth, truth).was_called_for);
}

// By hand the camera goes to and fro: no step is the usual one.
TEST(UsualStep, ThereIsNoneOfAnUnsteadyCamera) {
  MotionModel swaying;
  swaying.restart(SE3());
  for (int i = 0; i < kKnown + 10; ++i) {
    swaying.begin_frame(time_at(0.1 * i));
    swaying.follow(SE3::exp(twist(0, 0, i % 2 == 0 ? 0.01 : 0, 0, 0, 0)));
  }
  ASSERT_TRUE(swaying.steady().usual());
  EXPECT_FALSE(UsualStep::of(swaying));
}

}  // namespace
}  // namespace edgevo
