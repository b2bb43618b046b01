// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs a list with the engine (share/workflow), collects the rows of its table and writes the table.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/benchmark/bench_host.h"
#include "edgevo/benchmark/bench_list.h"
#include "edgevo/benchmark/bench_table.h"

namespace edgevo {

/// Paths of a benchmark.
struct BenchTarget {
  /// Path of the list, to which camera and parameter files are relative.
  std::string list_path;
  /// Output folder, and folder to which sources are relative.
  std::string out, data;
};

/// Options of the engine.
struct EngineOptions {
  /// Name of a profile in share/workflow/profiles, or a folder; empty: this machine.
  std::string profile;
  /// Number of cores, on a cluster of parallel jobs; 0: that of the profile.
  int cores = 0;
  /// Whether to show the jobs only.
  bool dry_run = false;
};

/// State of a benchmark.
struct BenchOutcome {
  /// Rows in the order of the list.
  std::vector<BenchRow> rows;
  /// Number of trials finished by this call, and before.
  int ran = 0, taken = 0;
  /// Folder of each finished job that was compared with ground truth, and whether its light was changed.
  std::vector<std::pair<std::string, bool>> evaluated_jobs;
  /// Reason of failure of the first trial that failed; empty: none failed.
  std::string first_failure;
};

/// Remaining work of a benchmark.
struct PlanSummary {
  /// Path of plan.json.
  std::string path;
  /// Number of unfinished trials, and of the jobs into which they are packed.
  int open_trials = 0, engine_jobs = 0;
};

/// Reads a list with the known changes of light and detectors. Throws InputError.
BenchList read_bench_list(const std::string& path);

/// Writes the plan for the engine without running it. Throws InputError for a bad source.
PlanSummary plan_bench(const BenchList& list, const BenchTarget& target, const BenchHost& host);

/// Runs the unfinished trials of the list, which is copied to OUT/workflow/list.yaml. Trials that fail or are
/// prevented by a signal are missing in their row. Throws InputError for a bad source, a missing engine, or
/// another engine running in OUT.
BenchOutcome run_bench(const BenchList& list, const BenchTarget& target, const EngineOptions& options,
                       const BenchHost& host);

/// Rows of the trials finished so far.
BenchOutcome collect_bench(const BenchList& list, const BenchTarget& target, const BenchHost& host);

/// Writes table.md and table.csv into OUT; returns the text of table.md. It ends with the figures of the
/// single frames, pooled over all finished jobs and over those with normal and with changed light, whose
/// results are read for it.
std::string write_bench_tables(const BenchList& list, const BenchOutcome& outcome, const BenchTarget& target,
                               const BenchHost& host);

/// Seeds of the list in words: "3 of each, seeds 1 2 3".
std::string seeds_text(const BenchList& list);

/// Name of the processor, from the operating system.
std::string processor_name();

}  // namespace edgevo
