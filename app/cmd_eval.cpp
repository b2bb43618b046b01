// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "commands.h"
#include "edgevo/benchmark/evaluated_runs.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/evaluation/alignment_hints.h"
#include "edgevo/evaluation/evaluate.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

struct EvalArguments {
  std::string trajectory, ground_truth;
  std::vector<std::string> more_runs;
  bool json = false;
  int frames_total = 0;
  double truth_sigma_m = 0, truth_sigma_deg = 0;
  TrajectoryReading reading, truth_reading;
  MapEvaluationRequest map;
};

using ReadTruth = std::function<Trajectory(const std::string& path)>;

bool is_file(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
}

// Two trajectories without common times may have different clocks.
TrajectoryEvaluation evaluate_or_explain(const Trajectory& estimate, const Trajectory& truth,
                                         const EvaluationOptions& options, double given_offset_s) {
  try {
    return evaluate(estimate, truth, options);
  } catch (const InputError& e) {
    const std::optional<double> offset = clock_offset(estimate, truth);
    if (!offset) throw;
    std::string what = e.what();
    what = what.substr(0, what.rfind("; "));
    throw InputError(what, "the clocks may differ",
                     "with --t-offset " + fixed(given_offset_s + *offset, 3) + " the paths fit");
  }
}

void print_hint(const std::string& hint) { std::fprintf(stderr, "HINT: %s\n", hint.c_str()); }

bool is_run(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

int eval_folders(const EvalArguments& args, const EvaluationOptions& options, const EvalRuns& eval_runs) {
  if (args.reading.t_offset_s != 0 || args.reading.w_first || args.reading.inverse)
    throw InputError(args.trajectory, "is the folder of a run, whose trajectory needs no other reading",
                     "omit --t-offset, --quaternion and --inverse; --truth-... are for the ground truth");
  RunEvaluationRequest request;
  request.paths = {args.trajectory};
  if (!args.ground_truth.empty()) request.paths.push_back(args.ground_truth);
  request.paths.insert(request.paths.end(), args.more_runs.begin(), args.more_runs.end());
  request.options = options;
  request.stated_noise = {args.truth_sigma_m, rad(args.truth_sigma_deg)};
  request.json = args.json;
  request.truth_reading = args.truth_reading;
  request.on_hint = print_hint;
  return eval_runs(request);
}

bool is_map(const std::string& path) { return std::filesystem::path(path).extension() == ".ply"; }

int eval_lines(const EvalArguments& args, const EvalMap& eval_map) {
  if (args.ground_truth.empty())
    throw InputError("SCENE", "is missing", "give the rendered scene that the map was made in");
  MapEvaluationRequest request = args.map;
  request.map = args.trajectory, request.scene = args.ground_truth, request.json = args.json;
  return eval_map(request);
}

void refuse_options_of_maps(const EvalArguments& args) {
  const MapEvaluationRequest& map = args.map;
  if (map.why || !map.page.empty() || !map.picture.empty() || map.seed)
    throw InputError(args.trajectory, "is no map: --why, --page, --picture and --seed are for edges.ply",
                     "give OUT/edges.ply and its scene, or omit them");
}

int run_eval(const EvalArguments& args, const ReadTruth& truth_of_source, const EvalRuns& eval_runs,
             const EvalMap& eval_map) {
  if (is_map(args.trajectory)) return eval_lines(args, eval_map);
  refuse_options_of_maps(args);
  EvaluationOptions options;
  if (args.frames_total > 0) options.frames_total = args.frames_total;
  if (is_run(args.trajectory)) return eval_folders(args, options, eval_runs);
  if (args.truth_sigma_m > 0 || args.truth_sigma_deg > 0)
    throw InputError(args.trajectory, "is no folder of a run: --truth-sigma-... is for its single frames",
                     "give the folder, or omit --truth-sigma-m and --truth-sigma-deg");
  if (args.ground_truth.empty())
    throw InputError("GROUNDTRUTH", "is missing", "give the true trajectory after the estimated one");
  if (!args.more_runs.empty())
    throw InputError(args.more_runs.front(), "is one path too many",
                     "give one trajectory, or folders of runs");
  Trajectory truth =
      is_file(args.ground_truth) ? read_trajectory(args.ground_truth) : truth_of_source(args.ground_truth);
  Trajectory estimate = read_trajectory(args.trajectory);
  reread(args.truth_reading, &truth);
  reread(args.reading, &estimate);
  const TrajectoryEvaluation e = evaluate_or_explain(estimate, truth, options, args.reading.t_offset_s);
  for (const std::string& hint : alignment_hints(estimate, truth, args.reading.t_offset_s)) print_hint(hint);
  std::fputs((args.json ? to_json(e) : to_table(e)).c_str(), stdout);
  return 0;
}

void add_reading_options(CLI::App& cmd, const std::string& prefix, const std::string& file,
                         TrajectoryReading* reading) {
  cmd.add_option_function<std::string>(
         "--" + prefix + "quaternion",
         [reading](const std::string& order) { reading->w_first = order == "wxyz"; },
         "order of the quaternions in " + file + ": xyzw (default) or wxyz")
      ->check(CLI::IsMember({"xyzw", "wxyz"}));
  cmd.add_flag("--" + prefix + "inverse", reading->inverse,
               "the poses in " + file + " are from the world to the camera");
}

}  // namespace

void add_eval_command(CLI::App& app, Action* action, ReadTruth truth_of_source, EvalRuns eval_runs,
                      EvalMap eval_map) {
  auto args = std::make_shared<EvalArguments>();
  CLI::App* cmd = app.add_subcommand(
      "eval",
      "compare a trajectory with ground truth: ATE, drift, scale, completion; or a map with its scene");
  cmd->add_option(
         "TRAJECTORY", args->trajectory,
         "trajectory in TUM format (8 numbers per line) or KITTI format (12); or the folder of a run, "
         "whose single frames are then evaluated as well; or edges.ply: completeness and rightness of its "
         "lines")
      ->required();
  cmd->add_option(
      "GROUNDTRUTH", args->ground_truth,
      "ground truth in TUM or KITTI format, or a data set folder; TUM may have its own rate "
      "(default for the folder of a run: the one that it recorded); of edges.ply: the rendered scene, as "
      "for `edgevo simulate`");
  cmd->add_option("RUN", args->more_runs,
                  "more folders of runs: the figures of their frames, one by one and pooled");
  cmd->add_flag("--json", args->json, "print JSON instead of a table");
  cmd->add_option(
         "--frames-total", args->frames_total,
         "number of input images, for completion and the blocks of ATE200 (default: from frames.csv next to "
         "TRAJECTORY, times.txt next to GROUNDTRUTH, or the length of the ground truth)")
      ->check(whole_number(1));
  cmd->add_option("--t-offset", args->reading.t_offset_s, "seconds to add to the times of TRAJECTORY")
      ->check(number_between(-1e10, 1e10));
  cmd->add_option(
         "--truth-sigma-m", args->truth_sigma_m,
         "known standard deviation of the true positions of a run, metres per axis; counts where it is "
         "larger than what they show (errors that a filter keeps do not show)")
      ->check(number_between(0, 1e6));
  cmd->add_option("--truth-sigma-deg", args->truth_sigma_deg, "the same of the true orientations, degrees")
      ->check(number_between(0, 180));
  cmd->add_option("--seed", args->map.seed, "for edges.ply: seed of the scene (default: that of the scene)")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()));
  cmd->add_option(
      "--picture", args->map.picture,
      "for edges.ply: PNG of one frame; edges in the map green, missing ones red, lines at no edge blue");
  cmd->add_option("--picture-frame", args->map.picture_frame, "frame of the picture (default 0)")
      ->check(whole_number(0));
  cmd->add_flag("--why", args->map.why,
                "for edges.ply: also why edges are missing, which takes some seconds for 100 frames");
  cmd->add_option("--page", args->map.page,
                  "for edges.ply: HTML page with all figures, why edges are missing, and pictures");
  add_reading_options(*cmd, "", "TRAJECTORY", &args->reading);
  add_reading_options(*cmd, "truth-", "GROUNDTRUTH", &args->truth_reading);
  cmd->callback([=] { *action = [=] { return run_eval(*args, truth_of_source, eval_runs, eval_map); }; });
}

}  // namespace edgevo::app
