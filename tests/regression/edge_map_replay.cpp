// SPDX-License-Identifier: BSD-3-Clause
// The lines of a finished run made again, from its own poses or the true ones, to measure a change of the
// lines alone:
//   edge_map_replay SCENE SEED EDGES_PLY [exact=1] [why=METRES] [picture=FRAME:FILE] [out=PLY]
//                   [GROUP.KEY=VALUE...]
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edge_replay.h"
#include "edgevo/core/error.h"
#include "edgevo/map_evaluation/map_figures.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/simulation/correspondence.h"
#include "edgevo/simulation/rendered_source.h"
#include "figures_request.h"

namespace edgevo::test {
namespace {

constexpr const char* kUsage =
    "edge_map_replay SCENE SEED EDGES_PLY [exact=1] [picture=FRAME:FILE] [GROUP.KEY=VALUE...]";

struct Request : FiguresRequest {
  std::string picture, missing;
  bool exact = false, between = false;
  double why = 0;
};

// The run without its lines.
Run read_run(const std::string& path) {
  Run run = read_edge_ply(path);
  for (KeyframeRecord& k : run.keyframes) k.lines.clear();
  return run;
}

// True poses in the unit of the run.
void take_true_poses(const Scene& scene, double metres_per_unit, Run* run) {
  for (KeyframeRecord& k : run->keyframes) {
    const SE3& T = scene.T_scene_cam[size_t(k.frame_index)];
    k.T_world_cam = SE3(T.R(), T.translation() / metres_per_unit);
  }
}

// Where the edge pixels of all keyframes within `why` metres end.
void print_stages(const Request& r, const SceneRenderer& renderer, const EdgeReplay& replay, double unit) {
  std::map<EdgeStage, std::array<int, 3>> counts;  // depth right, wrong, none
  int all = 0;
  const size_t colon = r.missing.find(':');
  const int drawn = colon == std::string::npos ? -1 : std::atoi(r.missing.c_str());
  for (size_t k = 0; k < replay.pyramids.size(); ++k) {
    const auto trace = replay.trace.find(int(k));
    if (trace == replay.trace.end()) continue;
    const ImageEdges& edges = replay.pyramids[k]->finest().edges;
    const std::vector<float> depth = renderer.render_depth(replay.run.keyframes[k].frame_index);
    cv::Mat picture;
    if (int(k) == drawn) picture = cv::Mat::zeros(2 * edges.height, 2 * edges.width, CV_8UC3);
    for (size_t i = 0; i < edges.pixels.size(); ++i) {
      const TracedPixel& t = trace->second[i];
      const double truth = edge_idepth({depth.data(), edges.width, edges.height, edges.width},
                                       edges.pixels[i].position().cast<double>()) *
                           unit;
      if (!(truth > 0) || unit / truth > r.why) continue;
      if (t.stage == EdgeStage::kNotTried) continue;
      const bool right = std::abs(t.idepth - truth) < 0.05 * truth;
      ++counts[t.stage][t.idepth > 0 ? (right ? 0 : 1) : 2];
      ++all;
      static const cv::Vec3b colours[] = {{90, 90, 90},   {255, 255, 255}, {255, 0, 255}, {160, 0, 160},
                                          {255, 120, 40}, {0, 140, 255},   {255, 200, 0}, {255, 255, 0},
                                          {0, 255, 255},  {0, 200, 0},     {0, 160, 0},   {0, 120, 0},
                                          {0, 0, 255},    {80, 80, 255},   {0, 255, 0}};
      if (!picture.empty()) {
        const cv::Point at(int(2 * edges.pixels[i].x + 1), int(2 * edges.pixels[i].y + 1));
        if (at.inside({1, 1, picture.cols - 2, picture.rows - 2}))
          cv::circle(picture, at, 1, right || t.idepth == 0 ? colours[size_t(t.stage)] : cv::Vec3b(0, 0, 255),
                     -1);
      }
    }
    if (!picture.empty()) cv::imwrite(r.missing.substr(colon + 1), picture);
  }
  std::cout << "edge pixels within " << r.why << " m: " << all << "; % right, wrong, none\n";
  for (const auto& [stage, n] : counts)
    std::printf("%-22s %6.2f %6.2f %6.2f\n", to_string(stage).c_str(), 100. * n[0] / all, 100. * n[1] / all,
                100. * n[2] / all);
}

// Errors of the vertices over their standard deviations, by the latter.
void print_sigmas(const SceneRenderer& renderer, const EdgeReplay& replay, double unit) {
  const double limits[] = {0.002, 0.004, 0.007, 0.01, 0.015, 0.02, 0.03, 1};
  std::map<int, std::vector<double>> errors, wrong;
  for (size_t k = 0; k < replay.pyramids.size(); ++k) {
    const std::vector<float> depth = renderer.render_depth(replay.run.keyframes[k].frame_index);
    const Pinhole& p = replay.run.pinhole;
    for (const EdgeLine& line : replay.run.keyframes[k].lines)
      for (const EdgeVertex& v : line.vertices) {
        const double t = edge_idepth({depth.data(), p.width, p.height, p.width}, v.px.cast<double>()) * unit;
        if (!(t > 0)) continue;
        const int bin = int(std::lower_bound(limits, limits + 7, double(v.idepth_sigma / v.idepth)) - limits);
        errors[bin].push_back(std::abs(double(v.idepth) - t) / double(v.idepth_sigma));
        wrong[bin].push_back(std::abs(double(v.idepth) - t) > 0.05 * t);
      }
  }
  for (auto& [bin, e] : errors) {
    std::sort(e.begin(), e.end());
    double n = 0;
    for (double w : wrong[bin]) n += w;
    const auto q = [&](double s) { return e[size_t(s * double(e.size() - 1))]; };
    std::printf(
        "sigma <= %.3f: %7zu vertices, |error| / sigma median %.2f, 68 %% %.2f, 90 %% %.2f, 95 %% %.2f; "
        "wrong %.3f\n",
        limits[bin], e.size(), q(0.5), q(0.68), q(0.9), q(0.95), n / double(e.size()));
  }
}

// Errors of the vertices, shares of their inverse depth, by what their depth comes from.
void print_errors(const SceneRenderer& renderer, const EdgeReplay& replay, double unit) {
  std::map<DepthSource, std::vector<double>> errors;
  for (const KeyframeRecord& k : replay.run.keyframes) {
    const std::vector<float> depth = renderer.render_depth(k.frame_index);
    const Pinhole& p = replay.run.pinhole;
    for (const EdgeLine& line : k.lines)
      for (const EdgeVertex& v : line.vertices)
        if (const double t =
                edge_idepth({depth.data(), p.width, p.height, p.width}, v.px.cast<double>()) * unit;
            t > 0)
          errors[line.source].push_back((double(v.idepth) - t) / t);
  }
  for (auto& [source, e] : errors) {
    std::sort(e.begin(), e.end());
    std::printf("%s: %zu vertices, error / idepth at 5, 10, 25, 50, 75, 90, 95 %%:",
                source == DepthSource::kPlane ? "plane" : "views", e.size());
    for (double q : {0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95})
      std::printf(" %.3f", e[size_t(q * double(e.size() - 1))]);
    std::printf("\n");
  }
}

int replay(const std::vector<std::string>& args) {
  Request r;
  const auto own = [&](const std::string& name, const std::string& value) {
    if (name == "exact")
      r.exact = value != "0";
    else if (name == "between")
      r.between = value != "0";
    else if (name == "why")
      r.why = std::atof(value.c_str());
    else if (name == "picture")
      r.picture = value;
    else if (name == "missing")
      r.missing = value;
    else
      return false;
    return true;
  };
  parse_figures_request(args, kUsage, own, &r);
  const auto renderer = std::make_shared<SceneRenderer>(load_scene(r.scene, r.seed));
  Run run = read_run(r.light);
  const double unit = evaluate_map(run, *renderer, {8, 2, 0.05, 0, 1}).metres_per_unit;
  if (r.exact) take_true_poses(renderer->scene(), unit, &run);
  for (const KeyframeRecord& k : run.keyframes) {  // for TrueEdges
    FrameRecord f;
    f.index = k.frame_index, f.T_world_cam = k.T_world_cam;
    run.frames.push_back(f);
  }
  KeepingSource source(std::make_unique<RenderedSource>(renderer, 0, run.keyframes.back().frame_index + 1));
  while (source.next()) {
  }
  PyramidBuilder builder(renderer->camera(), r.params.edges);
  const auto between = [&](int k, const auto& add) {
    const Scene& scene = renderer->scene();
    const int from = run.keyframes[size_t(k)].frame_index;
    const int to = k + 1 < int(run.keyframes.size()) ? run.keyframes[size_t(k) + 1].frame_index : from;
    for (int i = from + 1; i < to; ++i) {
      const SE3 T = scene.T_scene_cam[size_t(i)].inverse() * scene.T_scene_cam[size_t(from)];
      add(SE3(T.R(), T.translation() / unit), builder.build(source.image(i)));
    }
  };
  EdgeReplay replayed =
      replay_edges(source, run, r.params, r.between ? BetweenFrames(between) : BetweenFrames());
  std::cout << r.scene << (r.exact ? " exact" : " own") << ", "
            << replayed.cpu_ms / (run.keyframes.back().frame_index + 1) << " CPU ms a frame\n"
            << to_table(evaluate_map(replayed.run, *renderer));
  print_sigmas(*renderer, replayed, unit);
  print_errors(*renderer, replayed, unit);
  if (r.why > 0) print_stages(r, *renderer, replayed, unit);
  const size_t colon = r.picture.find(':');
  if (colon != std::string::npos)
    std::ofstream(r.picture.substr(colon + 1))
        << map_picture_png(replayed.run, *renderer, std::atoi(r.picture.c_str()));
  return 0;
}

}  // namespace
}  // namespace edgevo::test

int main(int argc, char** argv) {
  try {
    return edgevo::test::replay({argv + 1, argv + argc});
  } catch (const edgevo::InputError& e) {
    std::cerr << "edge_map_replay: " << e.what() << std::endl;
    return 2;
  }
}
