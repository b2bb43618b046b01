// SPDX-License-Identifier: BSD-3-Clause
// How a correction of the camera changes the keyframes that have left the window.
#include "run_records.h"

#include <gtest/gtest.h>

#include "edgevo/core/point_filter.h"
#include "support/sweep_scene.h"

namespace edgevo {
namespace {

// A point that the correction moves to infinity does not become more certain: its standard deviation follows
// the unit of length, not its own inverse depth.
TEST(RunRecords, ARevisionScalesTheSigmaOfAFarPointByTheUnit) {
  RunRecords records(test::Sweep::pinhole());
  records.begin_segment(0, Sim3());
  Keyframe keyframe;
  keyframe.pyramid = test::Sweep::pyramid(0);
  MapPoint point;
  point.px = {100, 100};
  point.normal = {1, 0};
  point.idepth = 1e-3, point.idepth_sigma = 1e-4;
  keyframe.points = {point};
  records.map().add_marginalised({keyframe}, 0);
  RevisedKeyframe revised;
  revised.length_ratio = 2;
  revised.points = {{{100, 100}, 1e-6}};
  records.map().revise({revised});
  const edgevo::Run run = records.finish();
  ASSERT_EQ(run.keyframes.size(), 1u);
  const EdgePoint& moved = run.keyframes[0].points.at(0);
  EXPECT_FLOAT_EQ(moved.idepth, 1e-6f);
  EXPECT_FLOAT_EQ(moved.idepth_sigma, 0.5e-4f);
  EXPECT_FALSE(PointFilter().keeps(moved));
}

// A frame that was tracked before a correction changed the unit of length at its keyframe is converted to the
// new unit, together with its covariance; a frame that was tracked later is in that unit already.
TEST(RunRecords, ARevisionChangesTheUnitOfEarlierFramesOnly) {
  constexpr int kKeyframe = 7;
  const SE3 T_cam_ref(Eigen::Quaterniond::Identity(), {0, 0, -1});
  RunRecords records(test::Sweep::pinhole());
  records.begin_segment(0, Sim3());
  const auto track = [&](int index) {
    Frame frame;
    frame.index = index;
    FrameRecord& record = records.begin_frame(frame);
    record.covariance = Matrix6d::Ones();
    records.place(&record, 0, kKeyframe, T_cam_ref, SE3());
  };
  track(0);
  RevisedKeyframe revised;
  revised.id = kKeyframe;
  revised.length_ratio = 2;
  records.map().revise({revised});
  track(1);
  Keyframe keyframe;
  keyframe.id = kKeyframe, keyframe.frame_index = 100;
  keyframe.pyramid = test::Sweep::pyramid(0);
  records.map().add_marginalised({keyframe}, 0);
  const edgevo::Run run = records.finish();
  ASSERT_EQ(run.frames.size(), 2u);
  for (const int i : {0, 1}) {
    const double unit = i == 0 ? 2 : 1;
    const SE3 T_ref_cam = run.keyframes.at(0).T_world_cam.inverse() * *run.frames[size_t(i)].T_world_cam;
    EXPECT_NEAR(T_ref_cam.translation().z(), unit, 1e-12) << i;
    const Matrix6d& covariance = run.frames[size_t(i)].covariance;
    EXPECT_NEAR(covariance(2, 2), unit * unit, 1e-12) << i;
    EXPECT_NEAR(covariance(2, 5), unit, 1e-12) << i;
    EXPECT_NEAR(covariance(5, 5), 1, 1e-12) << "angles have no unit of length, " << i;
  }
}

}  // namespace
}  // namespace edgevo
