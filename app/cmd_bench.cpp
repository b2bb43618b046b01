#include <cstdio>
#include <filesystem>
#include <memory>

#include "bench_run.h"
#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/evaluation/bench_table.h"
#include "edgevo/simulation/relight.h"
#include "option_checks.h"
#include "signals.h"
#include "version.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string list, out, data = ".";
};

std::string parameter_files(const BenchList& list) {
  std::string text;
  for (const BenchSequence& s : list.sequences)
    if (!s.params.empty()) text += ", " + s.params + " for " + s.name;
  return "the defaults" + text + "; in full in each job.yaml";
}

BenchHeader make_header(const BenchList& list) {
  std::string seeds;
  for (const uint64_t seed : list.seeds) seeds += (seeds.empty() ? "" : " ") + std::to_string(seed);
  return {{"edgevo", version()},
          {"machine", processor_name() + ", one thread a job"},
          {"trials", std::to_string(list.seeds.size()) + " of each, seeds " + seeds},
          {"parameters", parameter_files(list)},
          {"CPU", "of the odometry alone; images are read or rendered beforehand"}};
}

void throw_if_incomplete(const Progression& all, const std::string& out) {
  const std::string counts = std::to_string(all.ended()) + " of " + std::to_string(all.jobs) + " jobs have ended";
  if (interrupted()) throw InputError(out, "interrupted: " + counts, "call again to go on");
  if (all.first_failure) throw InputError(out, counts + "; first failure: " + all.first_failure->what(), "");
}

int bench(const BenchArguments& args) {
  const BenchList list =
      parse_bench_list(read_file(args.list, "give a list such as share/bench/rendered.yaml"), args.list, relight_kinds());
  Progression all;
  const std::vector<BenchRow> rows = run_list(list, args.list, args.out, args.data, &all);
  const BenchHeader header = make_header(list);
  const std::string table = bench_markdown(header, rows);
  write_file((fs::path(args.out) / "table.md").string(), table);
  write_file((fs::path(args.out) / "table.csv").string(), bench_csv(header, rows));
  std::printf("%s\n%d jobs: %d run, %d had been run before; table.md and table.csv in %s\n", table.c_str(), all.jobs, all.ran, all.taken,
              args.out.c_str());
  throw_if_incomplete(all, args.out);
  return 0;
}

}  // namespace

void add_bench_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("bench", "sequences x variants x seeds: runs, errors, one table");
  auto args = std::make_shared<BenchArguments>();
  command->add_option("LIST", args->list, "YAML list of sequences, such as share/bench/rendered.yaml")->required();
  command->add_option("-o,--out", args->out, "folder for table and jobs; jobs that ended there before are not run again")
      ->required()
      ->check(path_given());
  command->add_option("--data", args->data, "folder that the sources of LIST are in (default: the current one)")->check(path_given());
  command->callback([=] { *action = [=] { return bench(*args); }; });
}

}  // namespace edgevo::app
