// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/bench_step.h"

#include <algorithm>
#include <cstdio>

#include "bench_plan.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "file_lock.h"

namespace edgevo {
namespace {

constexpr int kInterrupted = 130;  // as in shells

const BenchSequence& sequence_of(const BenchList& list, const std::string& name) {
  for (const BenchSequence& sequence : list.sequences)
    if (sequence.name == name) return sequence;
  throw InputError(name, "is not a sequence of the list", "run edgevo bench to plan again");
}

const BenchVariant& variant_of(const BenchSequence& sequence, const std::string& name) {
  for (const BenchVariant& variant : sequence.variants)
    if (variant.name == name) return variant;
  throw InputError(sequence.name + "/" + name, "is not a variant of the list",
                   "run edgevo bench to plan again");
}

BenchJob job_of(const BenchInput& input, const BenchTarget& target, const std::string& variant, uint64_t seed,
                const std::string& version) {
  const BenchVariant& v = variant_of(input.sequence(), variant);
  BenchJob job = make_job(input, v, seed, target.out, version);
  const std::string key = edges_key(input, precomputed_by(v));
  if (!key.empty()) job.edges = workflow_path(target.out, "edges/" + key);
  return job;
}

void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

// Returns false if it failed.
bool run_trial(const BenchJob& job, BenchInput& input, const BenchHost& host) {
  try {
    const bool before = finished_trial(job).has_value();
    say(job.title() + (before ? ": had ended before" : ": begins"));
    if (before) return true;
    const std::optional<Trial> trial = run_job(job, input, host);
    if (trial) say(job.title() + ": ended, " + std::to_string(trial->frames) + " frames");
    return true;
  } catch (const InputError& e) {
    say(job.title() + ": failed: " + e.what());
    return false;
  }
}

}  // namespace

int run_planned_job(const BenchList& list, const BenchTarget& target, const std::string& id,
                    const BenchHost& host) {
  const EngineJob planned = planned_job(target.out, id);
  BenchInput input(sequence_of(list, planned.sequence), target.data, target.list_path);
  input.take_scene_from(workflow_path(target.out, "scenes/" + scene_key(input)));
  host.listen_to_signals();
  bool all_ended = true;
  for (const auto& [variant, seed] : planned.trials) {
    all_ended &= run_trial(job_of(input, target, variant, seed, host.version), input, host);
    if (host.stop()) return kInterrupted;
  }
  return all_ended ? 0 : 2;
}

int render_planned_scene(const BenchList& list, const BenchTarget& target, const std::string& key,
                         int threads) {
  BenchInput input(sequence_of(list, planned_scene(target.out, key)), target.data, target.list_path);
  const std::string folder = workflow_path(target.out, "scenes/" + key);
  make_output_folder(folder);
  const FileLock lock(folder);
  input.render_to(folder, threads);
  return 0;
}

}  // namespace edgevo
