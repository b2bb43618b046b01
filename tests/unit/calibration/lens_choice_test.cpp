// SPDX-License-Identifier: BSD-3-Clause
// Which lens the residuals choose, from synthetic corners with noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgevo/calibration/calibrate_camera.h"
#include "unit/calibration/drawn_board.h"

namespace edgevo {
namespace {

constexpr float kSide = 0.03f;

// The corners of a 9x6 board with 0.1 px of noise; empty if some of them are outside the image.
BoardView noisy_view(int frame, const SE3& T_cam_board, const Camera& camera) {
  BoardView view;
  view.frame = frame;
  Random random(uint64_t(frame) + 1);
  for (int i = 0; i < 54; ++i) {
    const Eigen::Vector2f p = kSide * Eigen::Vector2f(float(i % 9), float(i / 9));
    const auto px = camera.project(T_cam_board * Eigen::Vector3d(p.x(), p.y(), 0));
    if (!px || !(px->x() > 5 && px->y() > 5 && px->x() < camera.width - 5 && px->y() < camera.height - 5))
      return {};
    view.ids.push_back(i);
    view.p_board.push_back(p);
    view.px.push_back((*px + 0.1 * Eigen::Vector2d(random.normal(), random.normal())).cast<float>());
  }
  return view;
}

// A board at all places of the image, tilted to all sides; `spread`: largest x over z of its centre.
BoardViews all_views(const Camera& camera, double distance, double spread) {
  const Eigen::Vector3d centre(0.12, 0.075, 0);
  BoardViews all{camera.width, camera.height, 0, 0, {}};
  for (const double x : {-spread, -spread / 2, 0.0, spread / 2, spread})
    for (const double y : {-0.6 * spread, 0.0, 0.6 * spread})
      for (const double tilt : {-25.0, 25.0}) {
        const BoardView view = noisy_view(
            all.images,
            test::board_pose(centre, tilt - 30 * x, tilt * 0.8 + 30 * y, distance * Eigen::Vector3d(x, y, 1)),
            camera);
        ++all.images;
        if (view.px.empty()) continue;
        ++all.seen;
        all.views.push_back(view);
      }
  return all;
}

Camera camera_of(const CameraModel& model, double f) {
  Camera camera;
  camera.model = model;
  camera.set_pinhole({f, f, 240.5, 178.2, 480, 360});
  return camera;
}

// Largest distance between both cameras for the rays of corners.
double distance_between(const Camera& truth, const Camera& found, const BoardViews& all) {
  double most = 0;
  for (const BoardView& view : all.views)
    for (const Eigen::Vector2f& px : view.px) {
      const auto ray = truth.unproject(px.cast<double>());
      most = std::max(most, (*found.project(*ray) - *truth.project(*ray)).norm());
    }
  return most;
}

TEST(CalibratedLens, AFisheyeIsChosenForAFisheyeAndIsRight) {
  const Camera truth = camera_of(KannalaBrandtModel{{}, 0.01, -0.004, 0.001, -0.0003}, 170);
  const BoardViews all = all_views(truth, 0.2, 1.1);
  ASSERT_GT(all.views.size(), 12u);
  const CameraCalibration c = calibrate_camera(all, "board");
  EXPECT_STREQ(to_string(c.camera.model), "kannala_brandt");
  EXPECT_LT(c.rms_px, 0.16);
  EXPECT_LT(distance_between(truth, c.camera, all), 0.3);
  EXPECT_NEAR(c.camera.pinhole().fx, 170, 4 * c.sigma_f_px);
  EXPECT_LT(c.sigma_f_px, 1);
  ASSERT_EQ(c.tried.size(), 3u);
  EXPECT_FALSE(c.tried[0].rms_px < 1.1 * c.rms_px) << "plumb-bob, if it fits at all";
}

TEST(CalibratedLens, PlumbBobStaysThatOfAnOrdinaryLens) {
  const Camera truth = test::known_camera();
  const CameraCalibration c = calibrate_camera(all_views(truth, 0.5, 0.3), "board");
  EXPECT_STREQ(to_string(c.camera.model), "plumb_bob");
  EXPECT_EQ(c.tried.size(), 3u);
}

TEST(CalibratedLens, TheRequestedModelIsTheOnlyOneTried) {
  const Camera truth =
      camera_of(RationalModel{{}, {{0.9, 0.2, 0, 0, 0.01}, 1.2, 0.4, 0.03, 0, 0, 0, 0}}, 250);
  const BoardViews all = all_views(truth, 0.3, 1.1);
  const CameraCalibration c = calibrate_camera(all, "board", CalibratedLens::kRational);
  EXPECT_STREQ(to_string(c.camera.model), "rational");
  EXPECT_LT(distance_between(truth, c.camera, all), 1);
  EXPECT_EQ(c.tried.size(), 1u);
}

}  // namespace
}  // namespace edgevo
