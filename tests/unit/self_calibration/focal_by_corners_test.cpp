// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/self_calibration/focal_by_corners.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/radial.h"
#include "edgevo/core/random.h"

namespace edgevo {
namespace {

// A camera of 640x480 drives forward through a cloud of points, and turns by `turn` radians a frame.
struct Drive {
  double turn = 0.01;
  double file_over_true = 1;  // focal length
  double noise_px = 0.1;
  double outliers = 0;      // share of the corners that slide
  ImageCorrection applied;  // to the images
  int all_lost_at = -1;     // frame at which every corner gets a new number
  uint64_t seed = 1;
};

const Pinhole& true_camera() {
  static const Pinhole camera{500, 500, 320, 240, 640, 480};
  return camera;
}

Pinhole file_of(const Drive& drive) {
  Pinhole file = true_camera();
  file.fx *= drive.file_over_true, file.fy *= drive.file_over_true;
  return file;
}

std::optional<FocalError> error_after(const Drive& drive, int frames = 120) {
  Random random(drive.seed);
  const Pinhole camera = true_camera(), file = file_of(drive);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 4000; ++i)
    points.emplace_back(random.uniform(-30, 30), random.uniform(-6, 6), random.uniform(-10, 40));
  FocalByCorners focal{Rectification(file)};
  const SE3 step = SE3::exp((Vector6d() << 0.02, 0, -0.2, 0, drive.turn, 0).finished());
  SE3 T_cam_world;
  for (int f = 0; f < frames; ++f) {
    std::vector<FollowedCorner> corners;
    for (size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d p = T_cam_world * points[i];
      if (p.z() < 2 || p.z() > 30) continue;
      Eigen::Vector2d px = camera.project(p);
      if (!camera.contains(px)) continue;
      px += drive.noise_px * Eigen::Vector2d(random.normal(), random.normal());
      if (double(i % 100) < 100 * drive.outliers) px.x() += 0.7 * f;
      const uint32_t first_id = drive.all_lost_at >= 0 && f >= drive.all_lost_at ? 10000 : 0;
      const Eigen::Vector2d x = remove_lens(drive.applied, file.ray(px).head<2>());
      corners.push_back({first_id + uint32_t(i), x.homogeneous()});
    }
    if (corners.size() > 80) corners.resize(80);
    // The odometry turns by as much as the file says.
    SE3 seen = SE3::exp((Vector6d() << 0.02, 0, -0.2, 0, drive.turn / drive.file_over_true, 0).finished());
    focal.add(corners, f > 0 ? std::optional<SE3>(seen) : std::nullopt, drive.applied);
    T_cam_world = step * T_cam_world;
  }
  return focal.error();
}

TEST(FocalByCorners, ShowsTheWholeErrorOfTheFile) {
  for (const double file_over_true : {0.8, 1.25})
    for (const uint64_t seed : {1, 2, 3}) {
      Drive drive;
      drive.file_over_true = file_over_true, drive.seed = seed;
      const std::optional<FocalError> found = error_after(drive);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->value, 1 / file_over_true - 1, 0.04);
      EXPECT_GT(std::abs(found->value), 3 * found->sigma);
    }
}

// What is known of the lens may be taken from the images: the error is still that of the file.
TEST(FocalByCorners, SpeaksOfTheFileWhateverIsApplied) {
  Drive drive;
  drive.file_over_true = 0.8, drive.applied = {0.005, 0, 0.2};
  const std::optional<FocalError> found = error_after(drive);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 0.25, 0.04);
}

TEST(FocalByCorners, ConfirmsARightFile) {
  for (const uint64_t seed : {1, 2, 3}) {
    Drive drive;
    drive.seed = seed;
    const std::optional<FocalError> found = error_after(drive);
    ASSERT_TRUE(found);
    EXPECT_LT(std::abs(found->value), found->sigma);
  }
}

TEST(FocalByCorners, CornersThatSlideDoNotCount) {
  Drive drive;
  drive.outliers = 0.15;
  const std::optional<FocalError> found = error_after(drive);
  ASSERT_TRUE(found);
  EXPECT_LT(std::abs(found->value), found->sigma);
}

// A way straight on shows none, however wrong the file.
TEST(FocalByCorners, SaysNothingWithoutATurn) {
  Drive drive;
  drive.turn = 0, drive.file_over_true = 0.8;
  EXPECT_FALSE(error_after(drive));
}

TEST(FocalByCorners, SaysNothingBeforeThereAreSixViews) { EXPECT_FALSE(error_after(Drive(), 3)); }

TEST(FocalByCorners, GoesOnAfterAllCornersAreLost) {
  Drive drive;
  drive.all_lost_at = 2;
  EXPECT_TRUE(error_after(drive));
}

TEST(FocalByCorners, IsTheSameEachTime) {
  EXPECT_EQ(error_after(Drive())->value, error_after(Drive())->value);
}

}  // namespace
}  // namespace edgevo
