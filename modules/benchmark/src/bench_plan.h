#pragma once
// What the engine (share/workflow) is to do for a list: the open trials, packed into jobs, and what they need
// first.
//
//   OUT/workflow/list.yaml          the list, as it was given
//               plan.json           what follows, as the Snakefile reads it
//               jobs/ID.ended       exit code of the job; .log: what it said; .time: what it took
//               scenes/KEY, edges/KEY   what several jobs share; gone when they have ended
//
// A job is one trial while there are few; then the trials of a sequence are packed together, since the engine
// takes a millisecond and twenty kilobytes to plan a job, however long it runs.
#include <map>
#include <string>
#include <vector>

#include "bench_job.h"
#include "edgevo/benchmark/bench_run.h"

namespace edgevo {

/// Of one sequence, in the order of the list.
struct EngineJob {
  std::string sequence;
  std::vector<std::pair<std::string, uint64_t>> trials;  ///< variant and seed
  std::string scene;                                     ///< key; empty: none
  std::vector<std::string> edges;                        ///< keys
};

/// By what a scene, or the edges of a sequence by a detector, are known: a name for a folder.
std::string scene_key(const BenchInput& input);
std::string edges_key(const BenchInput& input, const std::string& detector);
/// The detector that the edges of a variant are computed by beforehand; empty: none are.
std::string precomputed_by(const BenchVariant& variant);

/// The trials of a job of the plan in OUT. Throws InputError: there is no such job.
EngineJob planned_job(const std::string& out, const std::string& id);
/// The sequence that renders a scene of the plan in OUT. Throws InputError.
std::string planned_scene(const std::string& out, const std::string& key);

/// OUT/workflow/NAME.
std::string workflow_path(const std::string& out, const std::string& name);

class BenchPlan {
 public:
  /// Looks which trials are open. Throws InputError: a source or a file that is not there.
  BenchPlan(const BenchList& list, const BenchTarget& target, const std::string& version);

  const std::map<std::string, EngineJob>& jobs() const { return jobs_; }  ///< by id
  int open_trials() const { return open_; }
  /// Writes list.yaml and plan.json, and takes away the signs that open jobs have ended before. Throws
  /// InputError.
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
