// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/evaluation/evaluate.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

struct EvalArguments {
  std::string trajectory, ground_truth;
  bool json = false;
  int frames_total = 0;
};

using ReadTruth = std::function<Trajectory(const std::string& path)>;

bool is_file(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
}

int run_eval(const EvalArguments& args, const ReadTruth& truth_of_source) {
  EvaluationOptions options;
  if (args.frames_total > 0) options.frames_total = args.frames_total;
  const Trajectory truth =
      is_file(args.ground_truth) ? read_trajectory(args.ground_truth) : truth_of_source(args.ground_truth);
  const TrajectoryEvaluation e = evaluate(read_trajectory(args.trajectory), truth, options);
  std::fputs((args.json ? to_json(e) : to_table(e)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_eval_command(CLI::App& app, Action* action, ReadTruth truth_of_source) {
  auto args = std::make_shared<EvalArguments>();
  CLI::App* cmd =
      app.add_subcommand("eval", "compare a trajectory with ground truth: ATE, drift, scale, completion");
  cmd->add_option("TRAJECTORY", args->trajectory,
                  "trajectory in TUM format (8 numbers per line) or KITTI format (12)")
      ->required();
  cmd->add_option("GROUNDTRUTH", args->ground_truth,
                  "ground truth in TUM or KITTI format, or a data set folder; TUM may have its own rate")
      ->required();
  cmd->add_flag("--json", args->json, "print JSON instead of a table");
  cmd->add_option(
         "--frames-total", args->frames_total,
         "number of input images, for completion and the blocks of ATE200 (default: from frames.csv next to "
         "TRAJECTORY, times.txt next to GROUNDTRUTH, or the length of the ground truth)")
      ->check(whole_number(1));
  cmd->callback([=] { *action = [=] { return run_eval(*args, truth_of_source); }; });
}

}  // namespace edgevo::app
