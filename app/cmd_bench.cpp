#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "bench_run.h"
#include "bench_step.h"
#include "commands.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/evaluation/bench_table.h"
#include "option_checks.h"
#include "signals.h"
#include "version.h"

namespace edgevo::app {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string list, out, data = ".", beside;
  EngineOptions engine;
  bool plan = false, table = false;  // steps of the engine, and its own call
  std::string job, scene;
  int threads = 1;
};

std::string parameter_files(const BenchList& list) {
  std::string text;
  for (const BenchSequence& s : list.sequences)
    if (!s.params.empty()) text += ", " + s.params + " for " + s.name;
  return "the defaults" + text + "; in full in each job.yaml";
}

// What the names of settings in the table stand for: "no_corners: KEY=VALUE; ..."; empty without any.
std::string settings_text(const BenchList& list) {
  std::map<std::string, std::vector<std::string>> settings;
  for (const BenchSequence& s : list.sequences)
    for (const BenchVariant& variant : s.variants)
      for (const BenchSetting& setting : variant.settings) settings[setting.name] = setting.assignments;
  std::string text;
  for (const auto& [name, assignments] : settings) {
    text += (text.empty() ? "" : "; ") + name + ":";
    for (const std::string& assignment : assignments) text += " " + assignment;
  }
  return text;
}

BenchHeader make_header(const BenchList& list) {
  std::string seeds;
  for (const uint64_t seed : list.seeds) seeds += (seeds.empty() ? "" : " ") + std::to_string(seed);
  BenchHeader header{{"edgevo", version()},
                     {"machine", processor_name() + ", one thread a job"},
                     {"trials", std::to_string(list.seeds.size()) + " of each, seeds " + seeds},
                     {"parameters", parameter_files(list)},
                     {"CPU", "of the odometry alone; images are read or rendered beforehand"}};
  if (const std::string settings = settings_text(list); !settings.empty())
    header.emplace_back("settings", settings);
  return header;
}

void throw_if_incomplete(const BenchOutcome& outcome, int jobs, const std::string& out) {
  const int ended = outcome.ran + outcome.taken;
  const std::string counts = std::to_string(ended) + " of " + std::to_string(jobs) + " jobs have ended";
  if (interrupted()) throw InputError(out, "interrupted: " + counts, "call again to go on");
  if (ended < jobs && outcome.first_failure.empty()) throw InputError(out, counts, "call again to go on");
  if (ended < jobs) throw InputError(out, counts + "; first failure: " + outcome.first_failure, "");
}

std::string write_tables(const BenchList& list, const BenchOutcome& outcome, const std::string& out) {
  const BenchHeader header = make_header(list);
  const std::string table = bench_markdown(header, outcome.rows);
  write_file((fs::path(out) / "table.md").string(), table);
  write_file((fs::path(out) / "table.csv").string(), bench_csv(header, outcome.rows));
  return table;
}

int plan_only(const BenchList& list, const BenchPlace& place) {
  const BenchPlan plan(list, place);
  plan.write(list, place);
  std::printf("%s: %d of %d jobs are open, %d for the engine\n",
              workflow_path(place.out, "plan.json").c_str(), plan.open_trials(), list.jobs(),
              int(plan.jobs().size()));
  return 0;
}

int run_all(const BenchList& list, const BenchPlace& place, const EngineOptions& engine) {
  const BenchOutcome outcome = run_bench(list, place, engine);
  if (engine.dry_run) return 0;
  const std::string table = write_tables(list, outcome, place.out);
  std::printf("%s\n%d jobs: %d run, %d had been run before; table.md and table.csv in %s\n", table.c_str(),
              list.jobs(), outcome.ran, outcome.taken, place.out.c_str());
  throw_if_incomplete(outcome, list.jobs(), place.out);
  return 0;
}

int bench(const BenchArguments& args) {
  const BenchList list = read_bench_list(args.list);
  const BenchPlace place{args.beside.empty() ? args.list : args.beside, args.out, args.data};
  if (!args.job.empty()) return run_planned_job(list, place, args.job);
  if (!args.scene.empty()) return render_planned_scene(list, place, args.scene, args.threads);
  if (args.table) return write_tables(list, collect_bench(list, place), args.out), 0;
  if (args.plan) return plan_only(list, place);
  return run_all(list, place, args.engine);
}

void add_engine_options(CLI::App* command, BenchArguments* args) {
  command
      ->add_option("--cores", args->engine.cores,
                   "jobs at a time (default 1: times in the table are then those of a job alone)")
      ->check(whole_number(1, 100000));
  command
      ->add_option(
          "--profile", args->engine.profile,
          "where jobs run: local (default), slurm, kubernetes, or a folder with Snakemake's config.yaml")
      ->check(path_given());
  command->add_flag("--dry-run", args->engine.dry_run, "say what would be run, and run nothing");
  command->add_flag("--plan", args->plan, "write OUT/workflow/plan.json for Snakemake, and run nothing");
}

// What share/workflow/Snakefile calls; not for users.
void add_steps(CLI::App* command, BenchArguments* args) {
  const std::string hidden;
  command->add_option("--beside", args->beside, "")->group(hidden);
  command->add_option("--job", args->job, "")->group(hidden);
  command->add_option("--scene", args->scene, "")->group(hidden);
  command->add_option("--threads", args->threads, "")->group(hidden)->check(whole_number(1, 1000));
  command->add_flag("--table", args->table, "")->group(hidden);
}

}  // namespace

void add_bench_command(CLI::App& app, Action* action) {
  CLI::App* command = app.add_subcommand("bench", "sequences x variants x seeds: runs, errors, one table");
  auto args = std::make_shared<BenchArguments>();
  command->add_option("LIST", args->list, "YAML list of sequences, such as share/bench/rendered.yaml")
      ->required();
  command
      ->add_option("-o,--out", args->out,
                   "folder for table and jobs; jobs that ended there before are not run again")
      ->required()
      ->check(path_given());
  command
      ->add_option("--data", args->data, "folder that the sources of LIST are in (default: the current one)")
      ->check(path_given());
  add_engine_options(command, args.get());
  add_steps(command, args.get());
  command->callback([=] { *action = [=] { return bench(*args); }; });
}

}  // namespace edgevo::app
