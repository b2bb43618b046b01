#include "edgevo/scale/given_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

Run small_run() {
  Run run;
  run.pinhole = {100, 100, 50, 40, 100, 80};
  FrameRecord frame;
  frame.T_world_cam = SE3(Eigen::Quaterniond(0.9, 0.1, 0.2, 0.1), {1, 2, 3});
  frame.T_world_cam_live = SE3(Eigen::Quaterniond::Identity(), {0, 0, 4});
  frame.covariance = Matrix6d::Identity();
  run.frames.push_back(frame);
  KeyframeRecord keyframe;
  keyframe.T_world_cam = *frame.T_world_cam;
  EdgePoint point;
  point.px = {60, 30};
  point.normal = {1, 0};
  point.idepth = 0.25f, point.idepth_sigma = 0.01f;
  keyframe.points.push_back(point);
  run.keyframes.push_back(keyframe);
  return run;
}

TEST(ScaleRun, EveryLengthGrowsAndNoAngleDoes) {
  const edgevo::Run before = small_run();
  edgevo::Run run = before;
  scale_run(2.5, "factor=2.5", &run);
  EXPECT_EQ(run.scale_source, "factor=2.5");
  EXPECT_TRUE(run.is_metric());
  EXPECT_LT((run.frames[0].T_world_cam->translation() - Eigen::Vector3d(2.5, 5, 7.5)).norm(), 1e-12);
  EXPECT_LT((run.frames[0].T_world_cam->R() - before.frames[0].T_world_cam->R()).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(run.frames[0].T_world_cam_live->translation().z(), 10);
  EXPECT_DOUBLE_EQ(run.frames[0].covariance(0, 0), 6.25);
  EXPECT_DOUBLE_EQ(run.frames[0].covariance(3, 3), 1);
  const auto world_point = [](const edgevo::Run& r) {
    return r.keyframes[0].T_world_cam * point_in_camera(r.pinhole, r.keyframes[0].points[0]);
  };
  EXPECT_LT((world_point(run) - 2.5 * world_point(before)).norm(), 1e-5);
}

TEST(ScaleRun, RefusesWhatIsNoFactor) {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    edgevo::Run run = small_run();
    EXPECT_THROW(scale_run(bad, "factor", &run), InputError) << bad;
  }
}

}  // namespace
}  // namespace edgevo
