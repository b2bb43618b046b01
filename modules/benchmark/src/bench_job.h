#pragma once
// One job of a benchmark: a sequence under a variant with a seed, and its folder of results.
//
//   OUT/SEQUENCE/VARIANT/seedN/trajectory_tum.txt, frames.csv   as `edgevo run` writes them
//                              result.yaml                      the figures (trial.h)
//                              ../groundtruth_tum.txt           where there is one, for `edgevo compare`
//                              job.yaml                         what was run, by which version; written last:
//                                                               the job has ended
//                              failure.txt                      instead of it: why it could not end
//
// A job whose job.yaml tells the same as it would write now is not run again.
#include <optional>

#include "bench_input.h"
#include "edgevo/benchmark/trial.h"

namespace edgevo {

struct BenchJob {
  std::string sequence;
  BenchVariant variant;
  uint64_t seed = 1;
  std::string folder, description;
  std::string edges;  ///< folder of those that were computed before; empty: none

  /// "desk normal seed 1"
  std::string title() const;
};

/// `out` is OUT, `version` what tells one build of the program from another.
BenchJob make_job(const BenchInput& input, const BenchVariant& variant, uint64_t seed, const std::string& out,
                  const std::string& version);

/// The result of a job that has ended before; nullopt if it has not, or was another one. Throws InputError
/// for a result that was changed by other hands.
std::optional<Trial> finished_trial(const BenchJob& job);

/// Why it could not end when it was tried last; empty: it has not been tried, or has ended.
std::string failure_of(const BenchJob& job);

/// Runs the job and writes its folder; nullopt when a signal has ended it. Waits for another process that is
/// at it, whose result it then takes. Throws InputError: a broken source, no room; failure.txt then says it,
/// too.
std::optional<Trial> run_job(const BenchJob& job, BenchInput& input, const BenchHost& host);

}  // namespace edgevo
