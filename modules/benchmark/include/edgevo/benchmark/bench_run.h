#pragma once
// A list run by the engine (share/workflow), the rows of its table, and the table's files.
#include <string>
#include <vector>

#include "edgevo/benchmark/bench_host.h"
#include "edgevo/benchmark/bench_list.h"
#include "edgevo/benchmark/bench_table.h"

namespace edgevo {

/// The folders of a benchmark.
struct BenchTarget {
  std::string list_path;  ///< camera and parameter files lie beside it
  std::string out, data;
};

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

/// What is left to do.
struct PlanSummary {
  std::string path;  ///< of plan.json
  int open_trials = 0, engine_jobs = 0;
};

/// Words for the parser of lists.
BenchList read_bench_list(const std::string& path);

/// Writes the plan for the engine, and runs nothing. Throws InputError: a bad source.
PlanSummary plan_bench(const BenchList& list, const BenchTarget& target, const BenchHost& host);

/// Runs what is open of the list, in OUT/workflow/list.yaml as it was given, whatever lies at
/// target.list_path. What fails, and what a signal keeps from being run, is missing in its row. Throws
/// InputError: a bad source, no engine, another at work in OUT.
BenchOutcome run_bench(const BenchList& list, const BenchTarget& target, const EngineOptions& options,
                       const BenchHost& host);

/// The rows of what has ended so far.
BenchOutcome collect_bench(const BenchList& list, const BenchTarget& target, const BenchHost& host);

/// Writes table.md and table.csv into OUT; returns the text of the first.
std::string write_bench_tables(const BenchList& list, const BenchOutcome& outcome, const BenchTarget& target,
                               const BenchHost& host);

/// "3 of each, seeds 1 2 3".
std::string seeds_text(const BenchList& list);

/// As the operating system names it.
std::string processor_name();

}  // namespace edgevo
