// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Single steps of a benchmark, for which the engine calls the program.
#include "edgevo/benchmark/bench_run.h"

namespace edgevo {

/// Runs the trials of a job of the plan one after the other and prints a line for each; a failure is reported
/// and does not stop the others. Returns the exit code: 0; 2 if some failed; 130 if ended by a signal.
int run_planned_job(const BenchList& list, const BenchTarget& target, const std::string& id,
                    const BenchHost& host);

/// Renders a scene of the plan, for all jobs that use it, on `threads` threads. Returns the exit code.
int render_planned_scene(const BenchList& list, const BenchTarget& target, const std::string& key,
                         int threads);

}  // namespace edgevo
