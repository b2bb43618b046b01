// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/occupancy/map_size.h"
#include "edgevo/results/run_maps.h"
#include "edgevo/results/run_params.h"
#include "edgevo/run_quality/run_statistics.h"
#include "option_checks.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

struct MapArguments {
  std::string run, out, params_file;
  std::vector<std::string> settings;
  std::optional<double> resolution, max_range;
  std::optional<CameraMount> mount;
  bool include_doubtful = false, force = false;
};

// A parameter of the odometry would be accepted without any effect.
void check_is_of_maps(const std::string& setting) {
  const std::string key = setting.substr(0, setting.find('='));
  MapParams maps;
  for (const ParamDescription& param : describe_params([&](ParamVisitor& v) { maps.visit(v); }))
    if (param.key == key) return;
  throw InputError("--set " + setting, "is of no use for a map",
                   "set parameters of occupancy or grid; others act in edgevo run");
}

MapParams params_from(const MapArguments& args) {
  RunParams params;
  const VisitParams visit = [&](ParamVisitor& v) { params.visit(v); };
  if (!args.params_file.empty()) read_params_given(args.params_file, visit);
  for (const std::string& setting : args.settings) {
    set_param(setting, visit);
    check_is_of_maps(setting);
  }
  if (args.resolution) params.map.occupancy.resolution = fixed(*args.resolution, 9);
  if (args.max_range) params.map.occupancy.max_range = fixed(*args.max_range, 9);
  params.map.check();
  return params.map;
}

void print_map(const Run& run, const MapReport& report, const std::string& out) {
  std::printf(
      "%s: voxels of %g, range %g, %lld occupied, %lld free, of %d points in %d keyframes; unit: %s\n",
      out.c_str(), report.octree.resolution, report.octree.max_range,
      (long long)report.octree.occupied_voxels, (long long)report.octree.free_voxels,
      report.octree.points.kept, report.octree.batches, unit_statement(run).c_str());
  if (!report.grid) return;
  std::printf("grid of %d x %d cells: %s\n", report.grid->width, report.grid->height,
              report.grid->statement.c_str());
}

// Maps of one run are not written into the folder of another.
void check_output(const MapArguments& args) {
  std::error_code ignored;
  if (fs::equivalent(args.run, args.out, ignored)) return;
  const bool is_of_a_run = fs::exists(fs::path(args.out) / "edges.ply", ignored);
  const std::vector<std::string> marks{"edges.ot", "edges.bt"};
  check_folder_is_ours(args.out, is_of_a_run ? std::vector<std::string>() : marks, args.force);
}

void print_size(const Run& run, const MapParams& params) {
  const MapSize size = estimate_map_size(run, params.occupancy);
  std::fprintf(stderr, "voxels of %g: about %.2g million, %.2g GB of memory\n", size.resolution,
               size.voxels / 1e6, size.bytes / 1e9);
}

MapReport write_maps(const Run& run, const MapParams& params, const std::string& out) {
  Progress progress("mapping keyframes", int(run.keyframes.size()));
  return write_map_files(run, params, out, [&](int done) { progress.update(done); });
}

// The points of a run; on request those of its doubtful keyframes, too, which lie in a file of their own.
Run read_map(const MapArguments& args) {
  Run run = read_edge_ply((fs::path(args.run) / "edges.ply").string());
  const std::string doubtful = (fs::path(args.run) / "edges_doubtful.ply").string();
  std::error_code ignored;
  if (!args.include_doubtful || !fs::exists(doubtful, ignored)) return run;
  const Run rest = read_edge_ply(doubtful);
  if (rest.keyframes.size() != run.keyframes.size())
    throw InputError(doubtful, "is not of the run of edges.ply", "run the sequence again");
  for (size_t k = 0; k < rest.keyframes.size(); ++k)
    run.keyframes[k].points.insert(run.keyframes[k].points.end(), rest.keyframes[k].points.begin(),
                                   rest.keyframes[k].points.end());
  return run;
}

void check_not_empty(const MapArguments& args, const Run& run) {
  const RunCounts n = count(run);
  if (n.points + n.lines > 0) return;
  std::error_code ignored;
  const bool may_help =
      !args.include_doubtful && fs::exists(fs::path(args.run) / "edges_doubtful.ply", ignored);
  throw InputError(args.run, "has no point that is certain enough for a map",
                   may_help ? "add --include-doubtful for those made in doubt" : "run a longer sequence");
}

int map(const MapArguments& args) {
  MapParams params = params_from(args);
  check_output(args);
  Run run = read_map(args);
  check_not_empty(args, run);
  if (args.mount) run.T_vehicle_cam = T_vehicle_cam(*args.mount);
  if (const std::string note = coarsen_to_fit(run, free_memory(), &params.occupancy); !note.empty())
    std::fprintf(stderr, "%s\n", note.c_str());
  check_map_size(run, params.occupancy, free_memory(), args.run);
  print_size(run, params);
  const MapReport report = write_maps(run, params, args.out);
  print_map(run, report, args.out);
  if (report.octree.occupied_voxels == 0)
    throw InputError(args.run,
                     "the map is empty: no point lies within a range of " + fixed(report.octree.max_range, 4),
                     "raise --max-range");
  return 0;
}

}  // namespace

void add_map_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("map", "rebuild octree and grid of a finished run at another resolution");
  auto args = std::make_shared<MapArguments>();
  command->add_option("RUN", args->run, "results folder of a finished `edgevo run`")->required();
  command
      ->add_option("-o,--out", args->out,
                   "folder for edges.bt, edges.ot, grid.yaml, grid.pgm, grid.gridmap.gz; may be RUN itself")
      ->required()
      ->check(path_given());
  command
      ->add_option("--resolution", args->resolution,
                   "size of voxels and cells, unit of the run (default: occupancy.resolution)")
      ->check(positive_number());
  command
      ->add_option("--max-range", args->max_range,
                   "largest distance from the path that is mapped, unit of the run")
      ->check(positive_number());
  add_mount(*command, &args->mount);
  command->add_option("--params", args->params_file,
                      "YAML file of parameters; only occupancy and grid are used");
  command
      ->add_option("--set", args->settings,
                   "set a parameter of occupancy or grid, GROUP.KEY=VALUE; repeatable")
      ->take_all()
      ->allow_extra_args(false);
  add_include_doubtful(*command, &args->include_doubtful);
  add_force(*command, &args->force);
  command->callback([=] { *action = [=] { return map(*args); }; });
}

}  // namespace edgevo::app
