#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/core/output_file.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/results/run_maps.h"
#include "edgevo/results/run_params.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

struct MapArguments {
  std::string run, out, params_file;
  std::vector<std::string> settings;
  std::optional<double> resolution, max_range;
};

MapParams params_as_asked(const MapArguments& args) {
  RunParams params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  if (!args.params_file.empty()) read_params_file(args.params_file, visit);
  for (const std::string& setting : args.settings) set_param(setting, visit);
  if (args.resolution) params.map.occupancy.resolution = fixed(*args.resolution, 9);
  if (args.max_range) params.map.occupancy.max_range = fixed(*args.max_range, 9);
  params.map.check();
  return params.map;
}

void print_map(const Run& run, const MapReport& report, const std::string& out) {
  std::printf("%s: voxels of %g, range %g, %lld occupied, %lld free, of %d points in %d keyframes; unit: %s\n", out.c_str(),
              report.octree.resolution, report.octree.max_range, (long long)report.octree.occupied_voxels,
              (long long)report.octree.free_voxels, report.octree.points.kept, report.octree.batches, unit_statement(run).c_str());
  if (!report.grid) return;
  std::printf("grid of %d x %d cells: %s\n", report.grid->width, report.grid->height, report.grid->statement.c_str());
}

int map(const MapArguments& args) {
  const MapParams params = params_as_asked(args);
  const Run run = read_edge_ply((fs::path(args.run) / "edges.ply").string());
  const MapReport report = write_map_files(run, params, args.out);
  print_map(run, report, args.out);
  return 0;
}

}  // namespace

void add_map_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("map", "octree and grid of a finished run again, at another resolution");
  auto args = std::make_shared<MapArguments>();
  command->add_option("RUN", args->run, "the folder of results of a finished `edgevo run`")->required();
  command->add_option("-o,--out", args->out, "folder for edges.bt, edges.ot, grid.yaml, grid.pgm, grid.gridmap.gz; may be RUN itself")
      ->required()
      ->check(path_given());
  command->add_option("--resolution", args->resolution, "edge of a voxel and of a cell, unit of the run (default: as occupancy.resolution)")
      ->check(positive_number());
  command->add_option("--max-range", args->max_range, "nothing farther from its keyframe is mapped, unit of the run")->check(positive_number());
  command->add_option("--params", args->params_file, "YAML file of parameters; of it, occupancy and grid count");
  command->add_option("--set", args->settings, "one parameter, GROUP.KEY=VALUE; may be given again")->take_all();
  command->callback([=] { *action = [=] { return map(*args); }; });
}

}  // namespace edgevo::app
