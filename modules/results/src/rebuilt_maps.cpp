// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/rebuilt_maps.h"

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/occupancy/map_size.h"
#include "edgevo/run_quality/run_statistics.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

Run read_points(const std::string& folder, bool include_doubtful) {
  Run run = read_edge_ply((fs::path(folder) / "edges.ply").string());
  const std::string doubtful = (fs::path(folder) / "edges_doubtful.ply").string();
  std::error_code ignored;
  if (!include_doubtful || !fs::exists(doubtful, ignored)) return run;
  const Run rest = read_edge_ply(doubtful);
  if (rest.keyframes.size() != run.keyframes.size())
    throw InputError(doubtful, "is not of the run of edges.ply", "run the sequence again");
  for (size_t k = 0; k < rest.keyframes.size(); ++k)
    run.keyframes[k].points.insert(run.keyframes[k].points.end(), rest.keyframes[k].points.begin(),
                                   rest.keyframes[k].points.end());
  return run;
}

void check_not_empty(const std::string& folder, bool include_doubtful, const Run& run) {
  const RunCounts n = count(run);
  if (n.points + n.lines > 0) return;
  std::error_code ignored;
  const bool may_help = !include_doubtful && fs::exists(fs::path(folder) / "edges_doubtful.ply", ignored);
  throw InputError(folder, "has no point that is certain enough for a map",
                   may_help ? "add --include-doubtful for those made in doubt" : "run a longer sequence");
}

}  // namespace

void check_is_of_maps(const std::string& setting) {
  const std::string key = setting.substr(0, setting.find('='));
  MapParams maps;
  for (const ParamDescription& param : describe_params([&](ParamVisitor& v) { maps.visit(v); }))
    if (param.key == key) return;
  throw InputError("--set " + setting, "is of no use for a map",
                   "set parameters of occupancy or grid; others act in edgevo run");
}

void check_map_folder(const std::string& run, const std::string& out, bool force) {
  std::error_code ignored;
  if (fs::equivalent(run, out, ignored)) return;
  const bool is_of_a_run = fs::exists(fs::path(out) / "edges.ply", ignored);
  const std::vector<std::string> marks{"edges.ot", "edges.bt"};
  check_folder_is_ours(out, is_of_a_run ? std::vector<std::string>() : marks, force);
}

Run read_run_map(const std::string& folder, bool include_doubtful) {
  Run run = read_points(folder, include_doubtful);
  check_not_empty(folder, include_doubtful, run);
  return run;
}

std::string map_size_text(const Run& run, const MapParams& params) {
  const MapSize size = estimate_map_size(run, params.occupancy);
  return formatted("voxels of %g: about %.2g million, %.2g GB of memory\n", size.resolution,
                   size.voxels / 1e6, size.bytes / 1e9);
}

std::string map_text(const Run& run, const MapReport& report, const std::string& out) {
  const std::string text = formatted(
      "%s: voxels of %g, range %g, %lld occupied, %lld free, of %d points in %d keyframes; unit: %s\n",
      out.c_str(), report.octree.resolution, report.octree.max_range,
      (long long)report.octree.occupied_voxels, (long long)report.octree.free_voxels,
      report.octree.points.kept, report.octree.batches, unit_statement(run).c_str());
  if (!report.grid) return text;
  return text + formatted("grid of %d x %d cells: %s\n", report.grid->width, report.grid->height,
                          report.grid->statement.c_str());
}

}  // namespace edgevo
