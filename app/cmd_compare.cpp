// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "edgevo/core/output_file.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/report/compare_page.h"
#include "edgevo/results/compared_runs.h"
#include "option_checks.h"

namespace edgevo::app {
namespace {

struct CompareArguments {
  std::vector<std::string> runs;
  std::string out, ground_truth;
  bool force = false;
};

int compare(const CompareArguments& args) {
  check_file_is_ours(args.out, kComparePageMark, args.force);
  const std::vector<ComparedRun> runs = compared_runs(args.runs, args.ground_truth, args.out);
  make_output_folder(std::filesystem::absolute(args.out).parent_path().string());
  write_file(args.out, compare_html(runs));
  int problems = 0;
  for (const ComparedRun& run : runs) problems += !run.problem.empty();
  std::printf("%s: %d run%s", args.out.c_str(), int(runs.size()), runs.size() == 1 ? "" : "s");
  if (problems > 0) std::printf(", of which %d cannot be compared; their rows say why", problems);
  std::printf("\n");
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "compare", "compare finished runs on one page: a table, worst first, and their paths");
  auto args = std::make_shared<CompareArguments>();
  command
      ->add_option(
          "RUN", args->runs,
          "folders of finished runs, or folders that contain runs, such as the output of `edgevo bench`")
      ->required();
  command->add_option("-o,--out", args->out, "page to write (a single HTML file)")
      ->required()
      ->check(path_given());
  command
      ->add_option("--truth", args->ground_truth,
                   "ground truth for all runs (default: the one recorded by each run)")
      ->check(path_given());
  add_force(*command, &args->force);
  command->callback([=] { *action = [=] { return compare(*args); }; });
}

}  // namespace edgevo::app
