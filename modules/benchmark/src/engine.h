// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs Snakemake on share/workflow/Snakefile with the plan of a benchmark.
#include <string>

#include "edgevo/benchmark/bench_run.h"

namespace edgevo {

/// Runs the plan in the folder `workflow`. Shows a progress line; the output of Snakemake goes to engine.log
/// in that folder (dry run: to stdout). SIGINT and SIGTERM end it and its jobs. Returns the reason why it did
/// not finish, one line; empty on success. Throws InputError if Snakemake or its files are not installed.
std::string run_engine(const std::string& workflow, const EngineOptions& options, const BenchHost& host);

}  // namespace edgevo
