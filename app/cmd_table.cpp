// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <memory>

#include "bench_host.h"
#include "commands.h"
#include "edgevo/benchmark/paper_run.h"
#include "edgevo/core/error.h"
#include "option_checks.h"
#include "signals.h"

namespace edgevo::app {
namespace {

int table(const PaperTableRequest& request) {
  const PaperTableResult result = run_paper_table(request, bench_host());
  std::printf("%s\n%s.md, .csv and .html\n", table_markdown(result.table).c_str(), result.stem.c_str());
  if (interrupted()) throw InputError(request.out, "interrupted", "run the same command again to continue");
  if (result.missing_trials > 0)
    throw InputError(request.out,
                     std::to_string(result.missing_trials) + " trials have no result; their cells say so",
                     "see what `edgevo bench " + request.out + "/list.yaml -o " + request.out + "` says");
  return 0;
}

}  // namespace

void add_table_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand(
      "table", "reproduce Table I or II of the paper, with its figures and ours, as text, CSV and HTML");
  auto args = std::make_shared<PaperTableRequest>();
  command->add_option("TABLE", args->which, "table of the paper: 1 (seasons of a lake shore) or 2 (KITTI)")
      ->required()
      ->check(CLI::IsMember({"1", "2"}));
  command
      ->add_option("-o,--out", args->out,
                   "folder for the table and its jobs; jobs done there before are not run again")
      ->required()
      ->check(path_given());
  command
      ->add_option(
          "--data", args->data,
          "for 1, an archive of Symphony Lake whose surveys are added; for 2, the folder of the sequences")
      ->check(path_given());
  CLI::Option* trials =
      command->add_option("--trials", args->trials,
                          "number of trials per sequence, with seeds 1 to N (default: those of the list)");
  trials->check(whole_number(1, 1000));
  command->add_option("--seeds", args->seeds, "seeds to use instead, as 1..5 or \"1 2 7\"")->excludes(trials);
  command
      ->add_option("--list", args->list,
                   "list of sequences to use (default: share/bench/table1.yaml or table2.yaml)")
      ->check(path_given());
  command->callback([=] { *action = [=] { return table(*args); }; });
}

}  // namespace edgevo::app
