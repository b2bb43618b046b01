// The map that a run leaves by default does not block the way that was driven: the vehicle was there.
#include <gtest/gtest.h>

#include "edgevo/occupancy/grid_map.h"
#include "edgevo/results/run_maps.h"
#include "street_drive.h"

namespace edgevo::test {
namespace {

constexpr double kWidth = 1.8;  // of the vehicle, metres

// In metres by the true positions.
edgevo::Run metric_drive(const std::string& scene, int frames) {
  const auto renderer = std::make_shared<SceneRenderer>(load_scene(scene));
  RenderedSource source(renderer, 0, frames);
  edgevo::Run run = drive(source);
  VehicleTrack track;
  for (size_t i = 0; i < size_t(frames); ++i)
    track.positions.push_back(
        {renderer->scene().times[i],
         renderer->scene().T_scene_cam[i].translation() - renderer->scene().T_scene_cam[0].translation()});
  const ScaleSource requested = parse_scale_source("robot_pose");
  const RunScale scale = estimate_run_scale(run, requested, track, ScaleParams());
  EXPECT_EQ(scale.problem, "");
  if (scale.problem.empty()) make_metric(scale, {}, requested, &run);
  return run;
}

// Frames whose vehicle, a disc, stands on an occupied cell.
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

void expect_free_way(const edgevo::Run& run, const std::string& scene) {
  const OctreeMap map(run, OccupancyParams());
  const double height = camera_height_of(run, GridParams());
  GridParams as_the_map_says;
  as_the_map_says.driven_width = 0;
  const OccupancyGrid grid = make_grid(run, map, height, GridParams());
  // Over water no ground is found and nothing is cleared: there the map itself must leave the way free.
  const double width = height > 0 ? std::min(kWidth, GridParams().driven_width * height) : kWidth;
  const int blocked = blocked_poses(run, grid, width);
  std::cout << "[ figures  ] " << scene << ": " << blocked << " of " << run.frames.size()
            << " poses blocked for a vehicle " << width << " m wide, without clearing "
            << blocked_poses(run, make_grid(run, map, height, as_the_map_says), width) << " ("
            << blocked_poses(run, make_grid(run, map, height, as_the_map_says), kWidth) << " at " << kWidth
            << " m); cells of " << grid.resolution << " m, camera " << height << " m high" << std::endl;
  EXPECT_EQ(blocked, 0);
  EXPECT_EQ(height > 0, scene != "lakeshore") << "the ground is not found: nothing is cleared";
  EXPECT_LE(grid.resolution, 0.2 + 1e-9);
}

class DrivenWay : public StreetDrive {};

TEST_F(DrivenWay, IsFreeOnTheStreet) { expect_free_way(*metric_run_, "street"); }

TEST(DrivenWayOf, TheCorridorIsFree) { expect_free_way(metric_drive("corridor", 100), "corridor"); }

TEST(DrivenWayOf, TheLakeshoreIsFree) { expect_free_way(metric_drive("lakeshore", 80), "lakeshore"); }

}  // namespace
}  // namespace edgevo::test
