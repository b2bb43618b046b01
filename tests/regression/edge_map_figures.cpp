// SPDX-License-Identifier: BSD-3-Clause
// Completeness and accuracy of the edge lines against a rendered scene, for tables:
//   edge_map_figures SCENE SEED [LIGHT | -] [frames=N] [why=1] [picture=KEYFRAME:FILE]
//                    [GROUP.KEY=VALUE...]
// `why` rebuilds the map from the final poses and prints why true edges are missing; `picture` draws them in
// one keyframe.
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <memory>

#include "edge_replay.h"
#include "edgevo/core/error.h"
#include "figures_request.h"
#include "missing_edges.h"
#include "run_figures.h"
#include "true_edges.h"

namespace edgevo::test {
namespace {

constexpr const char* kUsage =
    "edge_map_figures SCENE SEED [LIGHT | -] [frames=N] [why=1] [picture=KEYFRAME:FILE] "
    "[GROUP.KEY=VALUE...]";

struct Request : FiguresRequest {
  std::string picture;
  bool why = false;
};

Request parse(const std::vector<std::string>& args) {
  Request r;
  const auto own = [&](const std::string& name, const std::string& value) {
    if (name == "picture")
      r.picture = value, r.why = true;
    else if (name == "why")
      r.why = value != "0";
    else
      return false;
    return true;
  };
  parse_figures_request(args, kUsage, own, &r);
  return r;
}

double edge_map_ms(const Run& run) {
  double ms = 0;
  for (const FrameRecord& f : run.frames)
    for (const auto& [stage, cpu_ms] : f.stage_ms) ms += stage == "edge_map" ? cpu_ms : 0;
  return ms / double(run.frames.size());
}

void print_why(const Request& request, const KeepingSource& source, const Run& run, const TrueEdges& truth) {
  const EdgeReplay replay = replay_edges(source, run, request.params);
  std::cout << "rebuilt: " << truth.evaluate(replay.run) << "; " << replay.cpu_ms / double(run.frames.size())
            << " CPU ms a frame\n";
  for (const auto& [loss, share] : missing_edges(truth, replay))
    std::cout << "  " << std::fixed << std::setprecision(1) << std::setw(5) << 100 * share << " %  "
              << to_string(loss) << '\n';
  std::cout << std::defaultfloat << std::setprecision(6) << std::flush;
  const size_t colon = request.picture.find(':');
  if (colon != std::string::npos)
    draw_missing_edges(truth, replay, std::atoi(request.picture.c_str()), request.picture.substr(colon + 1));
}

int figures(const std::vector<std::string>& args) {
  const Request request = parse(args);
  const auto renderer = std::make_shared<SceneRenderer>(load_scene(request.scene, request.seed));
  KeepingSource source(images_of(request, renderer));
  const RunAccuracy run_figures = measure(run_source(source, request.params, request.seed),
                                          truth_of(renderer->scene(), 0, renderer->size()));
  const Run& run = run_figures.run;
  const bool is_desk = request.scene == "desk";
  const TrueEdges truth(*renderer, run, is_desk ? 2 : 20, is_desk ? 0.005 : 0.1);
  std::cout << request.scene << ' ' << request.seed << ' ' << request.light << ": " << truth.evaluate(run)
            << "; ATE " << run_figures.evaluation.ate_sim3.rmse << " m, edge map " << edge_map_ms(run)
            << " CPU ms a frame" << std::endl;
  if (request.why) print_why(request, source, run, truth);
  return 0;
}

}  // namespace
}  // namespace edgevo::test

int main(int argc, char** argv) {
  try {
    return edgevo::test::figures({argv + 1, argv + argc});
  } catch (const edgevo::InputError& e) {
    std::cerr << "edge_map_figures: " << e.what() << std::endl;
    return 2;
  }
}
