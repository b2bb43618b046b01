// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/given_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "edgevo/core/error.h"
#include "edgevo/scale/run_scale.h"

namespace edgevo {
namespace {

Run small_run() {
  Run run;
  run.pinhole = {100, 100, 50, 40, 100, 80};
  FrameRecord frame;
  frame.T_world_cam = SE3(Eigen::Quaterniond(0.9, 0.1, 0.2, 0.1), {1, 2, 3});
  frame.T_world_cam_live = SE3(Eigen::Quaterniond::Identity(), {0, 0, 4});
  frame.covariance = Matrix6d::Identity();
  frame.evidence.median_depth = 4;
  run.frames.push_back(frame);
  KeyframeRecord keyframe;
  keyframe.T_world_cam = *frame.T_world_cam;
  EdgePoint point;
  point.px = {60, 30};
  point.normal = {1, 0};
  point.idepth = 0.25f, point.idepth_sigma = 0.01f;
  keyframe.points.push_back(point);
  EdgeLine line;
  line.vertices = {{{20, 30}, 0.25f, 0.01f, 40, 200}, {{30, 30}, 0.5f, 0.02f, 40, 200}};
  keyframe.lines.push_back(line);
  run.keyframes.push_back(keyframe);
  return run;
}

TEST(ScaleRun, ScalesEveryLengthAndNoAngle) {
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
  EXPECT_DOUBLE_EQ(run.frames[0].evidence.median_depth, 10);
  const auto world_point = [](const edgevo::Run& r) {
    return r.keyframes[0].T_world_cam * point_in_camera(r.pinhole, r.keyframes[0].points[0]);
  };
  EXPECT_LT((world_point(run) - 2.5 * world_point(before)).norm(), 1e-5);
}

// Lines have depths of their own.
TEST(ScaleRun, ScalesLinesWithTheirPoints) {
  edgevo::Run run = small_run();
  scale_run(2.5, "factor=2.5", &run);
  const EdgeVertex& v = run.keyframes[0].lines[0].vertices[1];
  EXPECT_FLOAT_EQ(v.idepth, 0.5f / 2.5f);
  EXPECT_FLOAT_EQ(v.idepth_sigma, 0.02f / 2.5f);
}

// Measured factors, one for each frame, act like a given one if they are all equal.
TEST(ScaleRun, MeasuredFactorActsLikeAGivenOne) {
  edgevo::Run given = small_run(), measured = given;
  given.frames[0].covariance = measured.frames[0].covariance = Matrix6d::Ones();
  scale_run(2.5, "factor=2.5", &given);
  ScaleEstimate estimate;
  estimate.factor = 2.5, estimate.sigma = 0.1, estimate.samples = 10;
  make_metric({{estimate}, {}, "", {}}, {}, parse_scale_sources("odometry"), &measured);
  EXPECT_TRUE(measured.is_metric());
  EXPECT_LT((measured.frames[0].T_world_cam->matrix() - given.frames[0].T_world_cam->matrix()).norm(), 1e-12);
  EXPECT_LT((measured.frames[0].covariance - given.frames[0].covariance).norm(), 1e-12);
  EXPECT_LT((measured.keyframes[0].T_world_cam.matrix() - given.keyframes[0].T_world_cam.matrix()).norm(),
            1e-12);
  EXPECT_EQ(measured.keyframes[0].points[0].idepth, given.keyframes[0].points[0].idepth);
  EXPECT_EQ(measured.keyframes[0].lines[0].vertices[0].idepth_sigma,
            given.keyframes[0].lines[0].vertices[0].idepth_sigma);
}

TEST(ScaleRun, RefusesInvalidFactors) {
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    edgevo::Run run = small_run();
    EXPECT_THROW(scale_run(bad, "factor", &run), InputError) << bad;
  }
}

}  // namespace
}  // namespace edgevo
