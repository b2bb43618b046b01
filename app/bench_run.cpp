#include "bench_run.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/simulation/relight.h"
#include "engine.h"
#include "place_lock.h"
#include "version.h"

namespace edgevo::app {
namespace {

PlaceLock lock_of_engine(const std::string& out) {
  const std::string folder = workflow_path(out, "");
  make_output_folder(folder);
  std::optional<PlaceLock> lock = PlaceLock::try_lock_for_all(folder);
  if (!lock) throw InputError(out, "another edgevo is running a list there", "wait for it, or end it");
  return std::move(*lock);
}

void add_trial(const BenchJob& job, BenchRow* row, BenchOutcome* outcome) {
  ++row->missing;
  try {
    std::string failure = failure_of(job);
    if (const std::optional<Trial> trial = finished_trial(job)) {
      --row->missing;
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

// A job that the system has ended leaves no words of its own.
std::string unexplained_end(const BenchPlan& plan, const BenchPlace& place) {
  std::error_code ignored;
  for (const auto& [id, job] : plan.jobs()) {
    const std::string sign = workflow_path(place.out, "jobs/" + id + ".ended");
    if (!std::filesystem::exists(sign, ignored)) continue;
    const std::string code = read_file(sign, "");
    if (code != "0\n")
      return id + ": ended with code " + code.substr(0, code.find('\n')) + "; see " +
             workflow_path(place.out, "jobs/" + id + ".log");
  }
  return "";
}

}  // namespace

BenchList read_bench_list(const std::string& path) {
  return parse_bench_list(read_file(path, "give a list such as share/bench/rendered.yaml"), path,
                          relight_kinds(), edge_detector_names());
}

BenchOutcome collect_bench(const BenchList& list, const BenchPlace& place) {
  BenchOutcome outcome;
  for (const BenchSequence& sequence : list.sequences) {
    const BenchInput input(sequence, place.data, place.list_path);
    for (const BenchVariant& variant : sequence.variants) {
      outcome.rows.push_back({sequence.name, variant.name, {}, 0, variant.detector});
      for (const uint64_t seed : list.seeds)
        add_trial(make_job(input, variant, seed, place.out, version()), &outcome.rows.back(), &outcome);
    }
  }
  outcome.taken = ended(outcome);
  return outcome;
}

BenchOutcome run_bench(const BenchList& list, const BenchPlace& place, const EngineOptions& options) {
  const BenchPlan plan(list, place);
  const PlaceLock lock = lock_of_engine(place.out);
  plan.write(list, place);
  const bool anything = plan.open_trials() > 0 || options.dry_run;
  const std::string trouble = anything ? run_engine(workflow_path(place.out, ""), options) : "";
  BenchOutcome outcome = collect_bench(list, place);
  outcome.ran = std::max(0, outcome.taken - (list.jobs() - plan.open_trials()));
  outcome.taken -= outcome.ran;
  if (outcome.first_failure.empty()) outcome.first_failure = unexplained_end(plan, place);
  if (outcome.first_failure.empty() && ended(outcome) < list.jobs()) outcome.first_failure = trouble;
  return outcome;
}

std::vector<BenchRow> run_list(const BenchList& list, const std::string& list_path, const std::string& out,
                               const std::string& data) {
  return run_bench(list, {list_path, out, data}, {}).rows;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

}  // namespace edgevo::app
