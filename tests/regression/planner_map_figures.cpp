// SPDX-License-Identifier: BSD-3-Clause
// The octree of a run through a rendered scene as planners need it, with and without edge lines:
//   planner_map_figures SCENE SEED [LIGHT | -] [frames=N] [pairs=N] [radius=M] [GROUP.KEY=VALUE...]
// Prints the quality of the voxels, the thin obstacles, and paths between random positions next to the
// camera's path. A path collides where the centre of the ball comes nearer to a true surface than its radius
// less a voxel.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <random>

#include "edgevo/core/error.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/occupancy/octree_map.h"
#include "edgevo/scale/run_scale.h"
#include "figures_request.h"
#include "octree_planner.h"
#include "run_figures.h"
#include "support/temp_folder.h"
#include "thin_obstacles.h"
#include "true_scene.h"

namespace edgevo::test {
namespace {

constexpr double kRange = 20, kVoxel = 0.2;
constexpr double kReach = 1;     // metres from a wanted position to a free one
constexpr int kMaxSteps = 4000;  // of the planner
constexpr double kAside = 2;     // metres next to the path, at most
constexpr double kMinApart = 3;  // metres from start to goal

constexpr const char* kUsage =
    "planner_map_figures SCENE SEED [LIGHT | -] [frames=N] [pairs=N] [radius=M] [GROUP.KEY=VALUE...]";

struct Request : FiguresRequest {
  int pairs = 100;
  double radius = 0.5;
};

Request parse(const std::vector<std::string>& args) {
  Request r;
  const auto own = [&](const std::string& name, const std::string& value) {
    if (name == "pairs")
      r.pairs = std::atoi(value.c_str());
    else if (name == "radius")
      r.radius = std::atof(value.c_str());
    else
      return false;
    return true;
  };
  parse_figures_request(args, kUsage, own, &r);
  return r;
}

// In metres by the true positions of the camera.
Run in_metres(Run run, const Scene& scene) {
  VehicleTrack track;
  for (size_t i = 0; i < run.frames.size(); ++i)
    track.positions.push_back({scene.times[i], scene.T_scene_cam[i].translation()});
  const ScaleSources source = parse_scale_sources("robot_pose");
  const RunScale scale = estimate_run_scale(run, source, {{VehicleSensor::kRobotPose, track}}, ScaleParams());
  if (!scale.problem.empty()) throw InputError("scale", scale.problem, "drive further");
  make_metric(scale, {}, source, &run);
  return run;
}

Run without_lines(Run run) {
  for (KeyframeRecord& k : run.keyframes) k.lines.clear();
  return run;
}

struct Pair {
  Eigen::Vector3d start, goal;
};

// Pairs of positions next to the path, clear of every true surface.
std::vector<Pair> random_pairs(const Run& run, const TrueScene& truth, const Request& request) {
  std::vector<Eigen::Vector3d> path;
  for (const FrameRecord& f : run.frames)
    if (f.T_world_cam) path.push_back((T_map_world(run) * *f.T_world_cam).translation());
  std::mt19937 random(unsigned(request.seed));
  std::uniform_real_distribution<double> aside(-kAside, kAside), along(0, double(path.size()) - 1e-6);
  const auto position = [&] {
    for (;;) {
      const Eigen::Vector3d p =
          path[size_t(along(random))] + Eigen::Vector3d(aside(random), aside(random), 0);
      if (truth.distance(p, request.radius) >= request.radius) return p;
    }
  };
  std::vector<Pair> pairs;
  while (int(pairs.size()) < request.pairs) {
    const Pair pair{position(), position()};
    if ((pair.start - pair.goal).norm() >= kMinApart) pairs.push_back(pair);
  }
  return pairs;
}

// The true surface that a path comes too near to, and the map around the ball there.
void print_hit(const BallInOctree& ball, const TrueScene::Nearest& hit) {
  const Surface& s = *hit.surface;
  const Eigen::Vector3d normal = s.side_u.cross(s.side_v).normalized();
  std::cout << "      " << hit.distance << " m from a surface of " << s.side_u.norm() << " x "
            << s.side_v.norm() << " m, " << (std::abs(normal.z()) > 0.7 ? "level" : "upright") << ", at "
            << hit.at.transpose() << "; " << 100 * ball.share_free(hit.at)
            << " % of the ball observed to be free" << std::endl;
}

void print_paths(const BallInOctree& ball, const std::vector<Pair>& pairs, const TrueScene& truth,
                 double radius) {
  int with_ends = 0, solved = 0, hit = 0, through = 0;
  double least_of_all = 10;
  for (const Pair& pair : pairs) {
    const auto start = ball.free_position_near(pair.start, kReach),
               goal = ball.free_position_near(pair.goal, kReach);
    if (!start || !goal) continue;
    ++with_ends;
    const std::vector<Eigen::Vector3d> path = plan_3d(ball, *start, *goal, kMaxSteps);
    if (path.empty()) continue;
    const TrueScene::Nearest nearest = truth.nearest(path);
    if (nearest.distance < radius - kVoxel) print_hit(ball, nearest), ++hit;
    ++solved, through += nearest.distance < 0.05;
    least_of_all = std::min(least_of_all, nearest.distance);
  }
  std::cout << "    " << pairs.size() << " pairs: " << with_ends << " with a free start and goal, " << solved
            << " solved; " << hit << " paths nearer than " << radius - kVoxel << " m to a true surface, "
            << through << " through one; nearest " << least_of_all << " m" << std::endl;
}

void print_map(const Run& run, const TrueScene& truth, const std::vector<ThinObstacle>& thin,
               const std::vector<Pair>& pairs, double radius) {
  OccupancyParams params;
  params.resolution = "0.2", params.max_range = "20";
  const double start = thread_cpu_ms();
  const OctreeMap map(run, params);
  std::cout << "    " << thread_cpu_ms() - start << " ms of CPU for the octree\n";
  std::cout << "    " << truth.evaluate(map.tree(), run, params) << '\n';
  const ThinFigures f = evaluate_thin(thin, truth, map.tree(), kRange);
  std::cout << "    " << f << std::endl;
  for (const auto& [bar, share] : f.shares)
    std::cout << "      " << (bar.end - bar.begin).norm() << " m long, " << 100 * bar.thickness
              << " cm thick: " << 100 * share << " %\n";
  const test::TempFolder folder;
  map.write_bt(folder / "edges.bt");
  print_paths(BallInOctree(folder / "edges.bt", radius), pairs, truth, radius);
}

int figures(const std::vector<std::string>& args) {
  const Request request = parse(args);
  const auto renderer = std::make_shared<SceneRenderer>(load_scene(request.scene, request.seed));
  const std::unique_ptr<ImageSource> source = images_of(request, renderer);
  const Run run = in_metres(run_source(*source, request.params, request.seed), renderer->scene());
  const TrueScene truth(*renderer, run);
  const std::vector<ThinObstacle> thin = thin_obstacles(*renderer->scene().world);
  const std::vector<Pair> pairs = random_pairs(run, truth, request);
  seed_planner(unsigned(request.seed));
  std::cout << request.scene << ' ' << request.seed << ' ' << request.light << '\n' << "  with lines\n";
  print_map(run, truth, thin, pairs, request.radius);
  std::cout << "  points alone\n";
  print_map(without_lines(run), truth, thin, pairs, request.radius);
  return 0;
}

}  // namespace
}  // namespace edgevo::test

int main(int argc, char** argv) {
  try {
    return edgevo::test::figures({argv + 1, argv + argc});
  } catch (const edgevo::InputError& e) {
    std::cerr << "planner_map_figures: " << e.what() << std::endl;
    return 2;
  }
}
