// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/occupancy/map_size.h"
#include "edgevo/results/rebuilt_maps.h"
#include "edgevo/results/run_maps.h"
#include "edgevo/results/run_params.h"
#include "option_checks.h"
#include "progress.h"
#include "source_options.h"

namespace edgevo::app {
namespace {

struct MapArguments {
  std::string run, out, params_file;
  std::vector<std::string> settings;
  std::optional<double> resolution, max_range;
  std::optional<CameraMount> mount;
  bool include_doubtful = false, force = false;
};

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

MapReport write_maps(const Run& run, const MapParams& params, const std::string& out) {
  Progress progress("mapping keyframes", int(run.keyframes.size()));
  return write_map_files(run, params, out, [&](int done) { progress.update(done); });
}

int map(const MapArguments& args) {
  MapParams params = params_from(args);
  check_map_folder(args.run, args.out, args.force);
  Run run = read_run_map(args.run, args.include_doubtful);
  if (args.mount) run.T_vehicle_cam = T_vehicle_cam(*args.mount);
  if (const std::string note = coarsen_to_fit(run, free_memory(), &params.occupancy); !note.empty())
    std::fprintf(stderr, "%s\n", note.c_str());
  check_map_size(run, params.occupancy, free_memory(), args.run);
  std::fputs(map_size_text(run, params).c_str(), stderr);
  const MapReport report = write_maps(run, params, args.out);
  std::fputs(map_text(run, report, args.out).c_str(), stdout);
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
