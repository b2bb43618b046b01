#pragma once
// The single steps that the engine calls the program back for.
#include "edgevo/benchmark/bench_run.h"

namespace edgevo {

/// The trials of a job of the plan, one after the other, a line each; what fails is told and does not keep
/// the others from being run. Returns 0; 2: some failed; 130: a signal has ended it.
int run_planned_job(const BenchList& list, const BenchTarget& target, const std::string& id,
                    const BenchHost& host);

/// Renders a scene of the plan for all jobs, on so many threads.
int render_planned_scene(const BenchList& list, const BenchTarget& target, const std::string& key,
                         int threads);

}  // namespace edgevo
