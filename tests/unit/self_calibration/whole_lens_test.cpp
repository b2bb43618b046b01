// SPDX-License-Identifier: BSD-3-Clause
// A run states the whole lens that the matches show, and applies only k1.
#include <gtest/gtest.h>

#include "camera_finder.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

// A scene as a camera sees it whose file is wrong by `error`.
CameraProblem seen_through(const ba::Unknowns& error, uint64_t seed) {
  test::SceneOptions o;
  o.noise_px = 0.1;
  o.seed = seed;
  CameraProblem problem;
  problem.file = test::make_scene(o);
  problem.rectification = problem.file.pinhole;
  const Pinhole& c = problem.file.pinhole;
  const auto by_file = [&](const Eigen::Vector2d& px) {
    return c.project(CameraError(error).to_file(c, {}, c.ray(px).head<2>()).homogeneous());
  };
  for (const BaPoint& p : problem.file.points) problem.px_host.push_back(by_file(c.project(p.ray)));
  for (BaObservation& match : problem.file.observations) match.px = by_file(match.px);
  return problem;
}

CameraPosterior found(const ba::Unknowns& error, uint64_t seed) {
  SelfCalibrationParams params;
  params.refine = "k1";
  params.min_keyframes = 1;
  return find_camera(seen_through(error, seed), {}, params, test::to_the_end()).state;
}

TEST(WholeLens, IsStatedWithItsSigmas) {
  for (const uint64_t seed : {1, 2, 3}) {
    const CameraPosterior c = found(of_each(0.015, 0, -0.01, 0.02, 0), seed);
    EXPECT_GT(c.whole.keyframes, 0);
    EXPECT_GT(c.focal_sigma(), 0);
    // Of the step from a distant start, a part is missing.
    EXPECT_NEAR(c.whole.mean_of(CameraNumber::kFocal), 0.02, 3 * c.focal_sigma() + 0.002);
    EXPECT_NEAR(c.whole.mean_of(CameraNumber::kK1), 0.015, 3 * c.whole.sigma_of(CameraNumber::kK1) + 0.002);
    EXPECT_NEAR(c.whole.mean_of(CameraNumber::kK2), -0.01, 3 * c.whole.sigma_of(CameraNumber::kK2) + 0.002);
  }
}

TEST(WholeLens, ARightFileIsNotContradicted) {
  for (const uint64_t seed : {4, 5, 6}) {
    const CameraPosterior c = found(ba::Unknowns::Zero(), seed);
    EXPECT_GT(c.whole.keyframes, 0);
    EXPECT_FALSE(c.contradicts_focal_length())
        << c.whole.mean_of(CameraNumber::kFocal) << " +- " << c.focal_sigma();
  }
}

TEST(WholeLens, IsNotSoughtWithoutTheLens) {
  SelfCalibrationParams params;
  params.refine = "readout";
  EXPECT_EQ(find_camera(seen_through(ba::Unknowns::Zero(), 1), {}, params, test::to_the_end())
                .state.whole.keyframes,
            0);
}

}  // namespace
}  // namespace edgevo
