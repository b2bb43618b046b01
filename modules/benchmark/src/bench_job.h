// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A job of a benchmark: a sequence under a variant with a seed, and the folder of its results.
//
//   OUT/SEQUENCE/VARIANT/seedN/trajectory_tum.txt, trajectory_live_tum.txt, frames.csv, covariances.csv
//                                                               as `edgevo run` writes them
//                              result.yaml                      figures (trial.h)
//                              ../groundtruth_tum.txt           if there is one, for `edgevo compare`
//                              job.yaml                         inputs and version; written last: the job is
//                                                               finished
//                              failure.txt                      instead of job.yaml: reason of the failure
//
// A job whose job.yaml equals the one that it would write now is not run again.
#include <optional>

#include "bench_input.h"
#include "edgevo/benchmark/trial.h"

namespace edgevo {

/// A job: one trial.
struct BenchJob {
  std::string sequence;
  BenchVariant variant;
  uint64_t seed = 1;
  std::string folder, description;
  /// Folder of precomputed edges; empty: none.
  std::string edges;

  /// Title for progress and messages: "desk normal seed 1".
  std::string title() const;
};

/// Describes a job with results below `out`; `version` identifies the build of the program.
BenchJob make_job(const BenchInput& input, const BenchVariant& variant, uint64_t seed, const std::string& out,
                  const std::string& version);

/// Result of a finished job; nullopt if it is not finished or its inputs have changed. Throws InputError for
/// a result that was modified by hand.
std::optional<Trial> finished_trial(const BenchJob& job);

/// Reason of failure of the last attempt; empty: not tried yet, or finished.
std::string failure_of(const BenchJob& job);

/// Runs the job and writes its folder; nullopt if ended by a signal. If another process is running the job,
/// waits and takes its result. Throws InputError for a broken source or a full disk and writes the reason to
/// failure.txt.
std::optional<Trial> run_job(const BenchJob& job, BenchInput& input, const BenchHost& host);

}  // namespace edgevo
