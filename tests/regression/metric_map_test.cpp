// SPDX-License-Identifier: BSD-3-Clause
// A metric run through the rendered street and its map against the true surfaces. The bounds leave a margin
// to the measured figures (lab 2026-11-22_metric_map).
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <filesystem>

#include "edgevo/datasets/open_source.h"
#include "street_run.h"
#include "thin_obstacles.h"
#include "true_scene.h"

namespace edgevo::test {
namespace {

class MetricMap : public StreetRun {};

TEST_F(MetricMap, LengthFromTheHeightOfTheCamera) {
  const double ratio = scale_ratio(in_metres("camera_height=1.65", {}));
  std::cout << "[ figures  ] length over truth " << ratio << std::endl;
  EXPECT_NEAR(ratio, 1, 0.03);
}

TEST_F(MetricMap, LengthFromOdometryWithTwoPercentOfNoise) {
  const double ratio = scale_ratio(in_metres("odometry", track(0.02)));
  std::cout << "[ figures  ] length over truth " << ratio << std::endl;
  EXPECT_NEAR(ratio, 1, 0.01);
}

// Occupied voxels lie on surfaces; free voxels do not lie behind one.
TEST_F(MetricMap, VoxelsAgainstTheTrueSurfaces) {
  const MapQuality quality = truth_->evaluate(map_->tree(), *metric_run_, map_params());
  std::cout << "[ figures  ] " << quality << std::endl;
  EXPECT_GE(quality.occupied_on_surface, 0.95);
  EXPECT_LE(quality.free_behind_surface, 0.001);
  EXPECT_GE(quality.mapped_points_occupied, 0.9);
  EXPECT_GE(quality.true_edges_occupied, 0.87);
  EXPECT_GE(quality.crossing_edges_occupied, 0.95);
  EXPECT_GT(quality.occupied, 1000);
  EXPECT_GT(quality.free, 250000);
}

// Lamps and posts of signs, 5 to 15 cm thick: a planner needs the whole column.
TEST_F(MetricMap, PolesAreColumns) {
  const std::vector<ThinObstacle> obstacles = thin_obstacles(*renderer_->scene().world);
  const ThinFigures thin = evaluate_thin(obstacles, *truth_, map_->tree(), 20);
  std::cout << "[ figures  ] " << thin << std::endl;
  EXPECT_GE(thin.upright, 5);
  EXPECT_GE(thin.occupied_length, 0.6 * thin.length);
}

// KITTI's camera sits 1.65 m over the road.
TEST(RealMetres, KittiFromTheHeightOfTheCamera) {
  SourceOptions options;
  options.path = std::string(EDGEVO_DATA_DIR) + "/kitti00_first300";
  options.last = 160;  // 120 m
  if (!std::filesystem::is_directory(options.path))
    GTEST_SKIP() << "NOT TESTED: there is no " << options.path << "; configure with -DEDGEVO_DATA_DIR=DIR";
  edgevo::Run run = run_source(*open_source(options));
  const ScaleSources requested = parse_scale_sources("camera_height=1.65");
  const RunScale scale = estimate_run_scale(run, requested, {}, ScaleParams());
  ASSERT_EQ(scale.problem, "");
  make_metric(scale, {}, requested, &run);
  const RunAccuracy figures = measure(std::move(run), read_trajectory(options.path + "/groundtruth_tum.txt"));
  const TrajectoryEvaluation& e = figures.evaluation;
  double length = 0;
  const Trajectory estimate = trajectory_of(figures.run);
  for (size_t i = 1; i < estimate.poses.size(); ++i)
    length += (estimate.poses[i].T_world_cam.translation() - estimate.poses[i - 1].T_world_cam.translation())
                  .norm();
  std::cout << "[ figures  ] length over truth " << length / figures.path_m << ", ATE SE(3) "
            << e.ate_se3.rmse << " m, Sim(3) " << e.ate_sim3.rmse << " m" << std::endl;
  EXPECT_NEAR(length / figures.path_m, 1, 0.03);
  EXPECT_LE(e.ate_se3.rmse, 1.5 * e.ate_sim3.rmse + 1);
}

}  // namespace
}  // namespace edgevo::test
