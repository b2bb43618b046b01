// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The sub-commands of `edgevo`, in the program edgevo-commands (`eval` also in front_main.cpp). Each function
// adds a sub-command with its options to the parser; if that sub-command is requested, parsing stores its
// work in `*action`. The action returns the exit code (0 done, 1 nothing found, 3 tracking failed for most of
// the sequence or a quarter of the poses is doubtful) and throws edgevo::InputError for bad input (main
// prints it as one line, exit code 2).
#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace edgevo {
struct RunEvaluationRequest;
struct Trajectory;
}  // namespace edgevo

namespace edgevo::app {

using Action = std::function<int()>;

/// Adds `run`; `command_line` is recorded in summary.yaml.
void add_run_command(CLI::App& app, Action* action, std::vector<std::string> command_line);
void add_finish_command(CLI::App& app, Action* action);
void add_import_command(CLI::App& app, Action* action);
void add_edges_command(CLI::App& app, Action* action);
void add_info_command(CLI::App& app, Action* action);
/// Evaluates finished runs (benchmark/evaluated_runs.h) and prints; returns the exit code.
using EvalRuns = std::function<int(const RunEvaluationRequest& request)>;
/// A map to compare with the rendered scene that it was made in (map_evaluation/map_figures.h).
struct MapEvaluationRequest {
  /// edges.ply, and the name or YAML file of the scene.
  std::string map, scene;
  /// Seed of the scene, if it is not that of its file.
  std::optional<uint64_t> seed;
  /// Frame to draw, and the PNG to draw it into; "": none.
  int picture_frame = 0;
  std::string picture;
  /// HTML page to write; "": none.
  std::string page;
  /// Whether to say why edges are missing.
  bool why = false;
  bool json = false;
};
/// Compares a map with its scene and prints; returns the exit code.
using EvalMap = std::function<int(const MapEvaluationRequest& request)>;
int eval_map(const MapEvaluationRequest& request);
/// Adds `eval`; `truth_of_source` reads the ground truth of a data set if GROUNDTRUTH is not a file,
/// `eval_runs` takes over if TRAJECTORY is a folder, `eval_map` if it is a PLY file.
void add_eval_command(CLI::App& app, Action* action,
                      std::function<Trajectory(const std::string& path)> truth_of_source, EvalRuns eval_runs,
                      EvalMap eval_map);
void add_simulate_command(CLI::App& app, Action* action);
void add_relight_command(CLI::App& app, Action* action);
void add_overlay_command(CLI::App& app, Action* action);
/// Adds `mask`, which copies the mask that a run has found.
void add_mask_command(CLI::App& app, Action* action);
void add_study_command(CLI::App& app, Action* action);
void add_calibrate_command(CLI::App& app, Action* action);
void add_map_command(CLI::App& app, Action* action);
/// Adds `join`, for maps that runs have kept.
void add_join_command(CLI::App& app, Action* action);
void add_bench_command(CLI::App& app, Action* action);
void add_table_command(CLI::App& app, Action* action);
void add_compare_command(CLI::App& app, Action* action);
/// Adds `servo`, which replaces the process with the program edgevo-servo (servo_main.cpp).
void add_servo_command(CLI::App& app, Action* action);

}  // namespace edgevo::app
