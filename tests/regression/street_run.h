// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A run through the rendered street, its map and the ground truth for both, made once for all tests of the
// program: they take half a minute.
#include <gtest/gtest.h>

#include <random>

#include "edgevo/occupancy/octree_map.h"
#include "edgevo/scale/run_scale.h"
#include "edgevo/simulation/rendered_source.h"
#include "run_figures.h"
#include "true_scene.h"

namespace edgevo::test {

constexpr int kFrames = 110;

class StreetRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (run_) return;
    renderer_ = std::make_shared<SceneRenderer>(load_scene("street"));
    RenderedSource source(renderer_, 0, kFrames);
    run_ = new edgevo::Run(run_source(source));  // kept until the program ends: several suites use it
    metric_run_ = new edgevo::Run(in_metres("robot_pose", track(0)));
    truth_ = new TrueScene(*renderer_, *metric_run_);
    map_ = new OctreeMap(*metric_run_, map_params());
  }

  static OccupancyParams map_params() {
    OccupancyParams params;
    params.resolution = "0.2";
    params.max_range = "20";
    return params;
  }

  // Positions of the camera in metres, each step with 2 % of noise (0: exact).
  static VehicleTrack track(double noise) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    VehicleTrack track;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    const auto& poses = renderer_->scene().T_scene_cam;
    for (size_t i = 0; i < size_t(kFrames); ++i) {
      if (i > 0)
        position += (1 + noise * normal(random)) * (poses[i].translation() - poses[i - 1].translation());
      track.positions.push_back({renderer_->scene().times[i], position});
    }
    return track;
  }

  static edgevo::Run in_metres(const std::string& source, const VehicleTrack& track) {
    edgevo::Run run = *run_;
    const ScaleSources requested = parse_scale_sources(source);
    VehicleTracks tracks;
    if (const auto sensor = requested.list.front().sensor()) tracks[*sensor] = track;
    const RunScale scale = estimate_run_scale(run, requested, tracks, ScaleParams());
    EXPECT_EQ(scale.problem, "");
    if (scale.problem.empty()) make_metric(scale, {}, requested, &run);
    return run;
  }

  static double scale_ratio(const edgevo::Run& run) {
    double length = 0, truth = 0;
    const auto& poses = renderer_->scene().T_scene_cam;
    for (size_t i = 1; i < run.frames.size(); ++i) {
      if (!run.frames[i - 1].T_world_cam || !run.frames[i].T_world_cam) continue;
      length +=
          (run.frames[i].T_world_cam->translation() - run.frames[i - 1].T_world_cam->translation()).norm();
      truth += (poses[i].translation() - poses[i - 1].translation()).norm();
    }
    return length / truth;
  }

  inline static std::shared_ptr<SceneRenderer> renderer_;
  inline static edgevo::Run* run_ = nullptr;         // as tracked, arbitrary unit
  inline static edgevo::Run* metric_run_ = nullptr;  // scaled to metres by the true positions
  inline static TrueScene* truth_ = nullptr;
  inline static OctreeMap* map_ = nullptr;  // of metric_run_, voxels of 0.2 m
};

}  // namespace edgevo::test
