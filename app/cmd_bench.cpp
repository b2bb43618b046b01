// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "bench_host.h"
#include "commands.h"
#include "edgevo/benchmark/bench_run.h"
#include "edgevo/benchmark/bench_step.h"
#include "edgevo/core/error.h"
#include "option_checks.h"
#include "signals.h"

namespace edgevo::app {
namespace {

struct BenchArguments {
  std::string list, out, data = ".", list_file;
  EngineOptions engine;
  bool plan = false;
  std::optional<uint64_t> scene_seed;
  // Steps that the engine calls.
  bool table = false;
  std::string job, scene;
  int threads = 1;
};

void throw_if_incomplete(const BenchOutcome& outcome, int jobs, const std::string& out) {
  const int ended = outcome.ran + outcome.taken;
  const std::string counts = std::to_string(ended) + " of " + std::to_string(jobs) + " jobs are done";
  if (interrupted())
    throw InputError(out, "interrupted: " + counts, "run the same command again to continue");
  if (ended < jobs && outcome.first_failure.empty())
    throw InputError(out, counts, "run the same command again to continue");
  if (ended < jobs) throw InputError(out, counts + "; first failure: " + outcome.first_failure, "");
}

int plan_only(const BenchList& list, const BenchTarget& target) {
  const PlanSummary plan = plan_bench(list, target, bench_host());
  std::printf("%s: %d of %d jobs to do, %d for the workflow engine\n", plan.path.c_str(), plan.open_trials,
              list.jobs(), plan.engine_jobs);
  return 0;
}

int write_tables(const BenchList& list, const BenchTarget& target) {
  const BenchHost host = bench_host();
  write_bench_tables(list, collect_bench(list, target, host), target, host);
  return 0;
}

int run_all(const BenchList& list, const BenchTarget& target, const EngineOptions& engine) {
  const BenchHost host = bench_host();
  const BenchOutcome outcome = run_bench(list, target, engine, host);
  if (engine.dry_run) return 0;
  const std::string table = write_bench_tables(list, outcome, target, host);
  std::printf("%s\n%d jobs: %d run, %d done before; table.md and table.csv in %s\n", table.c_str(),
              list.jobs(), outcome.ran, outcome.taken, target.out.c_str());
  throw_if_incomplete(outcome, list.jobs(), target.out);
  return 0;
}

int bench(const BenchArguments& args) {
  BenchList list = read_bench_list(args.list);
  if (args.scene_seed) set_scene_seed(*args.scene_seed, "--scene-seed", &list);
  const BenchTarget target{args.list_file.empty() ? args.list : args.list_file, args.out, args.data};
  if (!args.job.empty()) return run_planned_job(list, target, args.job, bench_host());
  if (!args.scene.empty()) return render_planned_scene(list, target, args.scene, args.threads);
  if (args.table) return write_tables(list, target);
  if (args.plan) return plan_only(list, target);
  return run_all(list, target, args.engine);
}

void add_engine_options(CLI::App* command, BenchArguments* args) {
  command
      ->add_option(
          "--cores", args->engine.cores,
          "run N jobs at a time (default 1, so that the times in the table are those of a single job)")
      ->check(whole_number(1, 100000));
  command
      ->add_option("--profile", args->engine.profile,
                   "where to run the jobs: local (default), slurm, kubernetes, or a folder with a Snakemake "
                   "config.yaml")
      ->check(path_given());
  command->add_flag("--dry-run", args->engine.dry_run, "list what would be run, and run nothing");
  command->add_flag("--plan", args->plan, "write OUT/workflow/plan.json for Snakemake, and run nothing");
}

// Options for share/workflow/Snakefile; not for users.
void add_steps(CLI::App* command, BenchArguments* args) {
  const std::string hidden;
  command->add_option("--beside", args->list_file, "")->group(hidden);
  command->add_option("--job", args->job, "")->group(hidden);
  command->add_option("--scene", args->scene, "")->group(hidden);
  command->add_option("--threads", args->threads, "")->group(hidden)->check(whole_number(1, 1000));
  command->add_flag("--table", args->table, "")->group(hidden);
}

}  // namespace

void add_bench_command(CLI::App& app, Action* action) {
  CLI::App* command =
      app.add_subcommand("bench", "run a benchmark (sequences x variants x seeds) and tabulate the errors");
  auto args = std::make_shared<BenchArguments>();
  command->add_option("LIST", args->list, "YAML list of sequences, for example share/bench/rendered.yaml")
      ->required();
  command
      ->add_option("-o,--out", args->out,
                   "folder for the table and the jobs; jobs done there before are not run again")
      ->required()
      ->check(path_given());
  command
      ->add_option("--data", args->data,
                   "folder that holds the sources of LIST (default: the current folder)")
      ->check(path_given());
  command
      ->add_option("--scene-seed", args->scene_seed,
                   "seed of all scenes of LIST instead of its own, to repeat the scenes of another day")
      ->check(whole_number(0, std::numeric_limits<uint64_t>::max()));
  add_engine_options(command, args.get());
  add_steps(command, args.get());
  command->callback([=] { *action = [=] { return bench(*args); }; });
}

}  // namespace edgevo::app
