#pragma once
// A list run by the engine (share/workflow), and the rows of its table.
#include <string>
#include <vector>

#include "bench_plan.h"
#include "edgevo/evaluation/bench_table.h"

namespace edgevo::app {

struct EngineOptions {
  std::string profile;  ///< name of one in share/workflow/profiles, or a folder; empty: this machine
  int cores = 0;        ///< 0: as the profile says; jobs at a time on a cluster
  bool dry_run = false;
};

struct BenchOutcome {
  std::vector<BenchRow> rows;  ///< in the order of the list
  int ran = 0, taken = 0;      ///< trials that ended now, and that had ended before
  std::string first_failure;   ///< of a trial that has not ended; empty: there is none
};

/// Runs what is open of the list, in OUT/workflow/list.yaml as it was given, whatever lies at
/// place.list_path. What fails, and what a signal keeps from being run, is missing in its row. Throws
/// InputError: a bad source, no engine, another at work in OUT.
BenchOutcome run_bench(const BenchList& list, const BenchPlace& place, const EngineOptions& options);

/// The rows of what has ended so far.
BenchOutcome collect_bench(const BenchList& list, const BenchPlace& place);

/// run_bench as other commands need it, one job at a time.
std::vector<BenchRow> run_list(const BenchList& list, const std::string& list_path, const std::string& out,
                               const std::string& data);

/// Words for the parser of lists.
BenchList read_bench_list(const std::string& path);

/// As the operating system names it.
std::string processor_name();

}  // namespace edgevo::app
