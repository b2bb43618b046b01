#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/ground_truth.h"
#include "edgevo/datasets/source_folder.h"
#include "edgevo/evaluation/evaluate.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

struct EvalArguments {
  std::string trajectory, ground_truth;
  bool json = false;
  int frames_total = 0;
};

// What the source says of its ground truth, where it says so.
std::string remark_of(const ImageSource& source) {
  for (const auto& [name, value] : source.details())
    if (name == "ground truth") return value;
  return "it has no ground truth";
}

// A trajectory file, or the ground truth of a data set's folder; of the latter the path tells what it is.
Trajectory read_ground_truth(const std::string& path) {
  SourceOptions options;
  options.path = source_folder(path);
  options.any_camera = true;
  std::error_code ignored;
  if (!std::filesystem::is_directory(options.path, ignored)) return read_trajectory(path);
  const auto source = open_source(options);
  if (const std::string file = source->ground_truth_path(); !file.empty()) return read_trajectory(file);
  const std::string text = ground_truth_tum(options, *source);
  if (text.empty())
    throw InputError(options.path, "holds no ground truth: " + remark_of(*source), "give a trajectory file");
  Trajectory truth = parse_trajectory(text, options.path);
  truth.path = (std::filesystem::path(options.path) / remark_of(*source)).string();
  return truth;
}

int run_eval(const EvalArguments& args) {
  EvaluationOptions options;
  if (args.frames_total > 0) options.frames_total = args.frames_total;
  const TrajectoryEvaluation e =
      evaluate(read_trajectory(args.trajectory), read_ground_truth(args.ground_truth), options);
  std::fputs((args.json ? to_json(e) : to_table(e)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_eval_command(CLI::App& app, Action* action) {
  auto args = std::make_shared<EvalArguments>();
  CLI::App* cmd =
      app.add_subcommand("eval", "Compare a trajectory with ground truth: ATE, drift, scale, completion");
  cmd->add_option("TRAJECTORY", args->trajectory, "TUM (8 numbers a line) or KITTI (12) trajectory")
      ->required();
  cmd->add_option("GROUNDTRUTH", args->ground_truth,
                  "TUM or KITTI ground truth, or the folder of a data set; TUM may have a rate of its own")
      ->required();
  cmd->add_flag("--json", args->json, "print JSON instead of a table");
  cmd->add_option(
         "--frames-total", args->frames_total,
         "number of images that were put in, for completion and the blocks of ATE200; without it, frames.csv "
         "beside TRAJECTORY, times.txt beside GROUNDTRUTH, or the ground truth's lines tell")
      ->check(whole_number(1));
  cmd->callback([=] { *action = [=] { return run_eval(*args); }; });
}

}  // namespace edgevo::app
