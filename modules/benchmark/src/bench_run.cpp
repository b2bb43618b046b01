// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/bench_run.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "bench_plan.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/edges/edge_params.h"
#include "edgevo/frame_evaluation/frame_figures.h"
#include "edgevo/simulation/relight.h"
#include "engine.h"
#include "file_lock.h"

namespace edgevo {
namespace {

FileLock lock_of_engine(const std::string& out) {
  const std::string folder = workflow_path(out, "");
  make_output_folder(folder);
  std::optional<FileLock> lock = FileLock::try_lock_for_all(folder);
  if (!lock) throw InputError(out, "another edgevo is running a list there", "wait for it, or end it");
  return std::move(*lock);
}

void add_trial(const BenchJob& job, BenchRow* row, BenchOutcome* outcome) {
  ++row->missing;
  try {
    std::string failure = failure_of(job);
    if (const std::optional<Trial> trial = finished_trial(job)) {
      --row->missing;
      if (trial->evaluated_frames > 0)
        outcome->evaluated_jobs.emplace_back(job.folder, !job.variant.light.empty());
      row->trials.push_back(*trial);
    } else if (outcome->first_failure.empty()) {
      outcome->first_failure = failure;
    }
  } catch (const InputError& e) {
    if (outcome->first_failure.empty()) outcome->first_failure = e.what();
  }
}

int ended(const BenchOutcome& outcome) {
  size_t count = 0;
  for (const BenchRow& row : outcome.rows) count += row.trials.size();
  return int(count);
}

// A job ended by the system leaves no message of its own.
std::string unexplained_end(const BenchPlan& plan, const BenchTarget& target) {
  std::error_code ignored;
  for (const auto& [id, job] : plan.jobs()) {
    const std::string sign = workflow_path(target.out, "jobs/" + id + ".ended");
    if (!std::filesystem::exists(sign, ignored)) continue;
    const std::string code = read_file(sign, "");
    if (code != "0\n")
      return id + ": ended with code " + code.substr(0, code.find('\n')) + "; see " +
             workflow_path(target.out, "jobs/" + id + ".log");
  }
  return "";
}

std::string parameter_files(const BenchList& list) {
  std::string text;
  for (const BenchSequence& s : list.sequences)
    if (!s.params.empty()) text += ", " + s.params + " for " + s.name;
  return "the defaults" + text + "; in full in each job.yaml";
}

// Meaning of the names of settings in the table: "no_corners: KEY=VALUE; ..."; empty without any.
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

BenchHeader bench_header(const BenchList& list, const BenchHost& host) {
  BenchHeader header{{"edgevo", host.version},
                     {"machine", processor_name() + ", one thread a job"},
                     {"trials", seeds_text(list)},
                     {"parameters", parameter_files(list)},
                     {"CPU", "of the odometry alone; images are read or rendered beforehand"}};
  if (list.scene_seed) header.emplace_back("seed of all scenes", std::to_string(*list.scene_seed));
  if (const std::string settings = settings_text(list); !settings.empty())
    header.emplace_back("settings", settings);
  return header;
}

// Figures of the single frames of all jobs; empty if none has ground truth. A folder that was damaged since
// is skipped: its row is in the table above.
std::string pooled_frame_figures(const BenchOutcome& outcome) {
  std::vector<FrameEvaluation> all, normal, changed;
  for (const auto& [folder, is_relit] : outcome.evaluated_jobs) try {
      const std::filesystem::path variant = std::filesystem::path(folder).parent_path();
      const Trajectory truth = read_trajectory((variant / "groundtruth_tum.txt").string());
      all.push_back(evaluate_frames_in(folder, truth).live);
      (is_relit ? changed : normal).push_back(all.back());
    } catch (const InputError&) {
      continue;
    }
  if (all.empty()) return {};
  std::vector<NamedFigures> rows{{"all jobs", figures_of(all)}};
  if (!normal.empty() && !changed.empty()) {
    rows.push_back({"normal light", figures_of(normal)});
    rows.push_back({"changed light", figures_of(changed)});
  }
  return "\nSingle frames, pooled (live trajectory).\n\n" + frame_figures_markdown(rows);
}

// A sequence that cannot be opened is reported by its jobs.
void show_inputs(const BenchList& list, const BenchTarget& target, const BenchHost& host) {
  if (!host.show_input) return;
  for (const BenchSequence& sequence : list.sequences) try {
      const BenchInput input(sequence, target.data, target.list_path);
      host.show_input(sequence.name, input.decisions());
    } catch (const InputError&) {
      continue;
    }
}

}  // namespace

BenchList read_bench_list(const std::string& path) {
  return parse_bench_list(read_text(path, "give a list such as share/bench/rendered.yaml"), path,
                          relight_kinds(), edge_detector_names());
}

BenchOutcome collect_bench(const BenchList& list, const BenchTarget& target, const BenchHost& host) {
  BenchOutcome outcome;
  for (const BenchSequence& sequence : list.sequences) {
    const BenchInput input(sequence, target.data, target.list_path);
    for (const BenchVariant& variant : sequence.variants) {
      outcome.rows.push_back({sequence.name, variant.name, {}, 0, variant.detector});
      for (const uint64_t seed : list.seeds)
        add_trial(make_job(input, variant, seed, target.out, host.version), &outcome.rows.back(), &outcome);
    }
  }
  outcome.taken = ended(outcome);
  return outcome;
}

PlanSummary plan_bench(const BenchList& list, const BenchTarget& target, const BenchHost& host) {
  const BenchPlan plan(list, target, host.version);
  plan.write(list, target);
  return {workflow_path(target.out, "plan.json"), plan.open_trials(), int(plan.jobs().size())};
}

BenchOutcome run_bench(const BenchList& list, const BenchTarget& target, const EngineOptions& options,
                       const BenchHost& host) {
  const BenchPlan plan(list, target, host.version);
  const FileLock lock = lock_of_engine(target.out);
  plan.write(list, target);
  if (plan.open_trials() > 0 && !options.dry_run) show_inputs(list, target, host);
  const bool anything = plan.open_trials() > 0 || options.dry_run;
  const std::string trouble = anything ? run_engine(workflow_path(target.out, ""), options, host) : "";
  BenchOutcome outcome = collect_bench(list, target, host);
  outcome.ran = std::max(0, outcome.taken - (list.jobs() - plan.open_trials()));
  outcome.taken -= outcome.ran;
  if (outcome.first_failure.empty()) outcome.first_failure = unexplained_end(plan, target);
  if (outcome.first_failure.empty() && ended(outcome) < list.jobs()) outcome.first_failure = trouble;
  return outcome;
}

std::string seeds_text(const BenchList& list) {
  std::string seeds;
  for (const uint64_t seed : list.seeds) seeds += (seeds.empty() ? "" : " ") + std::to_string(seed);
  return std::to_string(list.seeds.size()) + " of each, seeds " + seeds;
}

std::string write_bench_tables(const BenchList& list, const BenchOutcome& outcome, const BenchTarget& target,
                               const BenchHost& host) {
  const BenchHeader header = bench_header(list, host);
  const std::string table = bench_markdown(header, outcome.rows) + pooled_frame_figures(outcome);
  write_file((std::filesystem::path(target.out) / "table.md").string(), table);
  write_file((std::filesystem::path(target.out) / "table.csv").string(), bench_csv(header, outcome.rows));
  return table;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

}  // namespace edgevo
