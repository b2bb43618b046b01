// SPDX-License-Identifier: BSD-3-Clause
// The default map of a run does not block the corridor that the vehicle drove through.
#include <gtest/gtest.h>
#include <algorithm>

#include "edgevo/occupancy/grid_map.h"
#include "edgevo/results/run_maps.h"
#include "street_run.h"

namespace edgevo::test {
namespace {

constexpr double kWidth = 1.8;  // of the vehicle, metres

// A run scaled to metres by the true positions.
edgevo::Run metric_run(const std::string& scene, int frames) {
  const auto renderer = std::make_shared<SceneRenderer>(load_scene(scene));
  RenderedSource source(renderer, 0, frames);
  edgevo::Run run = run_source(source);
  VehicleTrack track;
  for (size_t i = 0; i < size_t(frames); ++i)
    track.positions.push_back(
        {renderer->scene().times[i],
         renderer->scene().T_scene_cam[i].translation() - renderer->scene().T_scene_cam[0].translation()});
  const ScaleSources requested = parse_scale_sources("robot_pose");
  const RunScale scale =
      estimate_run_scale(run, requested, {{VehicleSensor::kRobotPose, track}}, ScaleParams());
  EXPECT_EQ(scale.problem, "");
  if (scale.problem.empty()) make_metric(scale, {}, requested, &run);
  return run;
}

// Number of frames where the vehicle, a disc, is on an occupied cell.
int blocked_poses(const edgevo::Run& run, const OccupancyGrid& grid, double width) {
  int blocked = 0;
  const int reach = int(std::ceil(0.5 * width / grid.resolution));
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam) continue;
    const Eigen::Vector2d p = (T_map_world(run) * f.T_world_cam->translation()).head<2>();
    const int x = int(std::floor((p.x() - grid.origin_x) / grid.resolution));
    const int y = int(std::floor((p.y() - grid.origin_y) / grid.resolution));
    bool is_blocked = false;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= grid.width || y + dy >= grid.height) continue;
        const Eigen::Vector2d cell(grid.origin_x + (x + dx + 0.5) * grid.resolution,
                                   grid.origin_y + (y + dy + 0.5) * grid.resolution);
        is_blocked |= (cell - p).norm() <= 0.5 * width && grid.at(x + dx, y + dy) == GridCell::kOccupied;
      }
    blocked += is_blocked;
  }
  return blocked;
}

void expect_free_corridor(const edgevo::Run& run, const std::string& scene) {
  const OctreeMap map(run, OccupancyParams());
  const double height = camera_height_of(run, GridParams());
  GridParams without_clearing;
  without_clearing.driven_width = 0;
  const OccupancyGrid grid = make_grid(run, map, height, GridParams());
  // Over water no ground is found and nothing is cleared: there the map itself must leave the corridor free.
  const double width = height > 0 ? std::min(kWidth, GridParams().driven_width * height) : kWidth;
  const int blocked = blocked_poses(run, grid, width);
  std::cout << "[ figures  ] " << scene << ": " << blocked << " of " << run.frames.size()
            << " poses blocked for a vehicle " << width << " m wide, without clearing "
            << blocked_poses(run, make_grid(run, map, height, without_clearing), width) << " ("
            << blocked_poses(run, make_grid(run, map, height, without_clearing), kWidth) << " at " << kWidth
            << " m); cells of " << grid.resolution << " m, camera " << height << " m high" << std::endl;
  EXPECT_EQ(blocked, 0);
  EXPECT_EQ(height > 0, scene != "lakeshore") << "the ground is not found: nothing is cleared";
  EXPECT_LE(grid.resolution, 0.2 + 1e-9);
}

class DrivenCorridor : public StreetRun {};

TEST_F(DrivenCorridor, IsFreeOnTheStreet) { expect_free_corridor(*metric_run_, "street"); }

TEST(DrivenCorridorOf, TheCorridorIsFree) { expect_free_corridor(metric_run("corridor", 100), "corridor"); }

TEST(DrivenCorridorOf, TheLakeshoreIsFree) { expect_free_corridor(metric_run("lakeshore", 80), "lakeshore"); }

}  // namespace
}  // namespace edgevo::test
