// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Plan of the engine (share/workflow) for a list: the unfinished trials, packed into jobs, and what they
// depend on.
//
//   OUT/workflow/list.yaml          the list as given
//               plan.json           the plan, read by the Snakefile
//               jobs/ID.ended       exit code of the job; .log: its output; .time: its duration
//               scenes/KEY, edges/KEY   shared by several jobs; removed when these are finished
//
// A job is one trial as long as there are few; many trials of a sequence are packed into one job, since the
// engine needs a millisecond and twenty kilobytes per job, however short.
#include <map>
#include <string>
#include <vector>

#include "bench_job.h"
#include "edgevo/benchmark/bench_run.h"

namespace edgevo {

/// A job of the engine: trials of one sequence, in the order of the list.
struct EngineJob {
  std::string sequence;
  /// Variant and seed of each trial.
  std::vector<std::pair<std::string, uint64_t>> trials;
  /// Key of its scene; empty: none.
  std::string scene;
  /// Keys of its precomputed edges.
  std::vector<std::string> edges;
};

/// Folder name of a scene, or of the edges of a sequence by a detector.
std::string scene_key(const BenchInput& input);
std::string edges_key(const BenchInput& input, const std::string& detector);
/// Detector whose edges are precomputed for a variant; empty: none.
std::string precomputed_by(const BenchVariant& variant);

/// Job `id` of the plan in `out`. Throws InputError if there is no such job.
EngineJob planned_job(const std::string& out, const std::string& id);
/// Name of the sequence that renders scene `key` of the plan in `out`. Throws InputError.
std::string planned_scene(const std::string& out, const std::string& key);

/// Path OUT/workflow/NAME.
std::string workflow_path(const std::string& out, const std::string& name);

/// Unfinished trials of a list, packed into jobs.
class BenchPlan {
 public:
  /// Finds the unfinished trials. Throws InputError for a missing source or file.
  BenchPlan(const BenchList& list, const BenchTarget& target, const std::string& version);

  /// Jobs by id.
  const std::map<std::string, EngineJob>& jobs() const { return jobs_; }
  /// Number of unfinished trials.
  int open_trials() const { return open_; }
  /// Writes list.yaml and plan.json, and removes the exit codes of earlier attempts of unfinished jobs.
  /// Throws InputError.
  void write(const BenchList& list, const BenchTarget& target) const;

 private:
  void add_sequence(const BenchList& list, const BenchSequence& sequence, const BenchTarget& target,
                    const std::string& version, size_t pack);
  void add_job(const BenchInput& input, EngineJob job);

  std::map<std::string, EngineJob> jobs_;
  std::map<std::string, std::string> scenes_;              // key -> sequence that renders it
  std::map<std::string, std::vector<std::string>> edges_;  // key -> source, detector, frames, camera
  int open_ = 0;
};

}  // namespace edgevo
