// SPDX-License-Identifier: BSD-3-Clause
// What the odometry refuses: images, cameras and parameters that it cannot use.
#include <gmock/gmock.h>

#include <string>

#include "edgevo/core/error.h"
#include "edgevo/odometry/odometry.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::sweep_frame;
using test::sweep_pose;
using test::trajectory_error;

TEST(OdometryInput, AnImageOfAnotherSizeThrowsAndKeepsWhatWasComputed) {
  Odometry odometry(test::sweep_camera(), OdometryParams(), OdometryOptions());
  for (int k = 0; k < 30; ++k) odometry.process(sweep_frame(k));
  Frame wrong = sweep_frame(30);
  wrong.image = test::make_image(160, 120, [](double, double) { return 0; });
  EXPECT_THROW(odometry.process(wrong), InputError);
  const auto run = odometry.finish();
  EXPECT_GE(run.frames.size(), 30u);
  EXPECT_EQ(trajectory_error(run, 0, 30, sweep_pose).poses, 30);
}

TEST(OdometryInput, AnUnusableCameraThrows) {
  Pinhole pinhole = test::sweep_camera().pinhole();
  pinhole.fx = 0;
  EXPECT_THROW(Odometry(Camera(pinhole), OdometryParams(), OdometryOptions()), InputError);
}

TEST(OdometryInput, AnUnknownDetectorThrows) {
  OdometryParams params;
  params.edges.detector = "cany";
  EXPECT_THROW(Odometry(test::sweep_camera(), params, OdometryOptions()), InputError);
}

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(OdometryParameters, UnknownKeysAreRejectedWithTheNearestName) {
  OdometryParams params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  EXPECT_THAT(error_of([&] { read_params("mapping:\n  window:\n    keyframe: 9\n", "x.yaml", visit); }),
              ::testing::HasSubstr("keyframes"));
  EXPECT_THAT(error_of([&] { set_param("recovery.max_frame=3", visit); }),
              ::testing::HasSubstr("max_frames"));
  EXPECT_THAT(error_of([&] { set_param("edges.detector=cany", visit); }), ::testing::HasSubstr("canny"));
  EXPECT_THAT(error_of([&] { set_param("mapping.window.keyframes=2", visit); }), ::testing::HasSubstr("30"));
}

TEST(OdometryParameters, WrittenParametersReadBack) {
  OdometryParams params, again;
  params.mapping.window.keyframes = 9;
  params.recovery.max_frames = 3;
  params.association.k_m = 0.5;
  const std::string text = write_params([&](ParamVisitor& v) { params.visit(v); });
  read_params(text, "text", [&](ParamVisitor& v) { again.visit(v); });
  EXPECT_EQ(write_params([&](ParamVisitor& v) { again.visit(v); }), text);
  EXPECT_EQ(again.mapping.window.keyframes, 9);
}

}  // namespace
}  // namespace edgevo
