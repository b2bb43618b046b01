#include "bench_run.h"

#include <fstream>

#include "bench_job.h"
#include "edgevo/core/output_file.h"
#include "signals.h"
#include "version.h"

namespace edgevo::app {
namespace {

// One job, or what it left before. False when a signal has ended it.
bool do_job(const BenchJob& job, BenchInput& input, BenchRow* row, Progression* all) {
  ++row->missing;
  try {
    std::optional<Trial> trial = finished_trial(job);
    int& count = trial ? all->taken : all->ran;
    if (!trial) {
      const std::string title = std::to_string(all->ended() + 1) + "/" + std::to_string(all->jobs) + " " +
                                row->sequence + " " + row->variant + " seed " + std::to_string(job.seed);
      trial = run_job(job, input, title);
      if (!trial) return false;
    }
    ++count, --row->missing;
    row->trials.push_back(*trial);
  } catch (const InputError& e) {
    if (!all->first_failure) all->first_failure = e;
  }
  return !interrupted();
}

std::vector<BenchRow> do_jobs(const BenchList& list, std::vector<BenchInput>& inputs, const std::string& out,
                              Progression* all) {
  std::vector<BenchRow> rows;
  bool go_on = true;
  for (BenchInput& input : inputs) {
    for (const BenchVariant& variant : input.sequence().variants) {
      rows.push_back({input.sequence().name, variant.name, {}, 0});
      for (const uint64_t seed : list.seeds) {
        if (go_on)
          go_on = do_job(make_job(input, variant, seed, out, version()), input, &rows.back(), all);
        else
          ++rows.back().missing;
      }
    }
    input.release();
  }
  return rows;
}

}  // namespace

std::vector<BenchRow> run_list(const BenchList& list, const std::string& list_path, const std::string& out,
                               const std::string& data, Progression* all) {
  std::vector<BenchInput> inputs;
  for (const BenchSequence& sequence : list.sequences) inputs.emplace_back(sequence, data, list_path);
  for (const BenchInput& input : inputs) input.check_output(out);
  make_output_folder(out);
  listen_to_signals();
  all->jobs = list.jobs();
  return do_jobs(list, inputs, out, all);
}

std::vector<BenchRow> run_list(const BenchList& list, const std::string& list_path, const std::string& out,
                               const std::string& data) {
  Progression all;
  return run_list(list, list_path, out, data, &all);
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

}  // namespace edgevo::app
