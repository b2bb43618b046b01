// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/alignment_hints.h"

#include <gmock/gmock.h>

#include "support/synthetic_trajectory.h"

namespace edgevo {
namespace {

using test::input_error_of;
using test::some_similarity;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Trajectory estimate_of(const Trajectory& truth) {
  return test::with_noise(test::seen_through(some_similarity(), truth), 0.01, 9);
}

template <class Change>
Trajectory changed(Trajectory t, const Change& change) {
  for (StampedPose& pose : t.poses) change(&pose);
  return t;
}

// Quaternions as if a file with w first were read as one with w last.
Trajectory misread_w_first(const Trajectory& t) {
  return changed(t, [](StampedPose* p) {
    const Eigen::Quaterniond q = p->T_world_cam.rotation();
    p->T_world_cam = SE3(Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()), p->T_world_cam.translation());
  });
}
Trajectory inverse(const Trajectory& t) {
  return changed(t, [](StampedPose* p) { p->T_world_cam = p->T_world_cam.inverse(); });
}
Trajectory shifted(const Trajectory& t, double s) {
  return changed(t, [s](StampedPose* p) { p->time = Timestamp::from_seconds(p->time.seconds() + s); });
}
Trajectory scaled(const Trajectory& t, double factor) {
  return changed(t, [factor](StampedPose* p) {
    p->T_world_cam = SE3(p->T_world_cam.rotation(), factor * p->T_world_cam.translation());
  });
}

class Hints : public ::testing::Test {
 protected:
  const Trajectory truth_ = test::winding_drive(600), est_ = estimate_of(truth_);
};

TEST_F(Hints, NoneForATrajectoryThatFitsOrThatIsWrong) {
  EXPECT_THAT(alignment_hints(est_, truth_), IsEmpty());
  EXPECT_THAT(alignment_hints(truth_, truth_), IsEmpty());
  EXPECT_THAT(alignment_hints(test::with_noise(est_, 10, 5), truth_), IsEmpty());
  EXPECT_THAT(alignment_hints(test::straight_drive(600), truth_), IsEmpty());
}

TEST_F(Hints, AnotherClockIsFoundToTheMillisecond) {
  EXPECT_THAT(alignment_hints(shifted(est_, 0.53), truth_), ElementsAre(HasSubstr("--t-offset -0.5")));
  EXPECT_THAT(alignment_hints(shifted(est_, -2), truth_), ElementsAre(HasSubstr("--t-offset 2.0")));
  Trajectory again = shifted(est_, 0.53);
  reread({-0.53, false, false}, &again);
  EXPECT_THAT(alignment_hints(again, truth_), IsEmpty());
}

TEST_F(Hints, AnOffsetAddsToTheOneThatWasGiven) {
  EXPECT_THAT(alignment_hints(shifted(est_, -2), truth_, 1.5), ElementsAre(HasSubstr("--t-offset 3.5")));
}

TEST_F(Hints, ATruthInMillisecondsIsFound) {
  const Trajectory milliseconds = changed(truth_, [](StampedPose* p) { p->time.ticks *= 1000; });
  EXPECT_THAT(alignment_hints(est_, milliseconds), ElementsAre(HasSubstr("in milliseconds?")));
}

TEST_F(Hints, AClockWithoutCommonTimesIsFoundToo) {
  const auto offset = clock_offset(shifted(est_, 1.7e9), truth_);
  ASSERT_TRUE(offset);
  EXPECT_NEAR(*offset, -1.7e9, 0.02);
  EXPECT_FALSE(clock_offset(shifted(test::straight_drive(600, 0.3), 1.7e9), truth_));
}

TEST_F(Hints, QuaternionsWithWFirstAreFoundAndReadAsSuch) {
  EXPECT_THAT(alignment_hints(misread_w_first(est_), truth_), ElementsAre(HasSubstr("--quaternion wxyz")));
  EXPECT_THAT(alignment_hints(est_, misread_w_first(truth_)),
              ElementsAre(HasSubstr("--truth-quaternion wxyz")));
  Trajectory again = misread_w_first(est_);
  reread({0, true, false}, &again);
  for (size_t i = 0; i < again.poses.size(); ++i)
    EXPECT_LT((again.poses[i].T_world_cam.R() - est_.poses[i].T_world_cam.R()).norm(), 1e-9);
}

TEST_F(Hints, PosesFromTheWorldToTheCameraAreFound) {
  EXPECT_THAT(alignment_hints(inverse(est_), truth_), ElementsAre(HasSubstr("--inverse")));
  EXPECT_THAT(alignment_hints(est_, inverse(truth_)), ElementsAre(HasSubstr("--truth-inverse")));
}

TEST_F(Hints, OtherAxesAreFound) {
  const SE3 T_cam_body = T_zup_world().inverse();
  const Trajectory body =
      changed(truth_, [&](StampedPose* p) { p->T_world_cam = p->T_world_cam * T_cam_body; });
  EXPECT_THAT(alignment_hints(est_, body), ElementsAre(HasSubstr("other axes")));
}

TEST_F(Hints, OtherUnitsAreFound) {
  const Trajectory metric = test::with_noise(truth_, 0.05, 3);
  EXPECT_THAT(alignment_hints(scaled(metric, 1000), truth_),
              ElementsAre(HasSubstr("positions of the trajectory may be in millimetres")));
  EXPECT_THAT(alignment_hints(metric, scaled(truth_, 100)),
              ElementsAre(HasSubstr("positions of the ground truth may be in centimetres")));
}

TEST_F(Hints, AKittiFileHasNeitherTimesNorQuaternions) {
  Trajectory kitti = est_;
  kitti.format = TrajectoryFormat::kKitti;
  EXPECT_THAT(input_error_of([&] { reread({1, false, false}, &kitti); }), HasSubstr("which has no times"));
  EXPECT_THAT(input_error_of([&] {
                reread({0, true, false}, &kitti);
              }),
              HasSubstr("which has no quaternions"));
  EXPECT_THAT(alignment_hints(kitti, truth_), IsEmpty());
}

}  // namespace
}  // namespace edgevo
