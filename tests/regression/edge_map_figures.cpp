// Completeness and accuracy of the lines of edges against a rendered scene, for tables:
//   edge_map_figures SCENE SEED [KIND OF LIGHT | -] [frames=N] [GROUP.KEY=VALUE...]
#include <cstdlib>
#include <iostream>
#include <memory>

#include "drive.h"
#include "edgevo/core/error.h"
#include "edgevo/simulation/relit_source.h"
#include "edgevo/simulation/rendered_source.h"
#include "true_edges.h"

namespace edgevo::testing {
namespace {

int figures(const std::vector<std::string>& args) {
  if (args.size() < 2) {
    std::cerr << "usage: edge_map_figures SCENE SEED [LIGHT | -] [frames=N] [GROUP.KEY=VALUE...]\n";
    return 2;
  }
  const uint64_t seed = std::strtoull(args[1].c_str(), nullptr, 10);
  OdometryParams params;
  int frames = -1;
  for (size_t i = 3; i < args.size(); ++i)
    if (args[i].rfind("frames=", 0) == 0)
      frames = std::atoi(args[i].c_str() + 7);
    else
      set_param(args[i], [&](ParamVisitor& v) { params.visit(v); });
  const auto renderer = std::make_shared<SceneRenderer>(load_scene(args[0], seed));
  std::unique_ptr<ImageSource> source = std::make_unique<RenderedSource>(renderer, 0, frames);
  if (args.size() > 2 && args[2] != "-")
    source = std::make_unique<RelitSource>(std::move(source), Relight(args[2], seed));
  const DriveFigures drive_figures =
      measure(drive(*source, params, seed), truth_of(renderer->scene(), 0, renderer->size()));
  const bool is_desk = args[0] == "desk";
  const TrueEdges truth(*renderer, drive_figures.run, is_desk ? 2 : 20, is_desk ? 0.005 : 0.1);
  double cpu_ms = 0;
  for (const FrameRecord& f : drive_figures.run.frames)
    for (const auto& [stage, ms] : f.stage_ms) cpu_ms += stage == "edge_map" ? ms : 0;
  std::cout << args[0] << ' ' << seed << ' ' << (args.size() > 2 ? args[2] : "-") << ": "
            << truth.judge(drive_figures.run) << "; ATE " << drive_figures.evaluation.ate_sim3.rmse
            << " m, edge map " << cpu_ms / double(drive_figures.run.frames.size()) << " CPU ms a frame"
            << std::endl;
  return 0;
}

}  // namespace
}  // namespace edgevo::testing

int main(int argc, char** argv) {
  try {
    return edgevo::testing::figures({argv + 1, argv + argc});
  } catch (const edgevo::InputError& e) {
    std::cerr << "edge_map_figures: " << e.what() << std::endl;
    return 2;
  }
}
