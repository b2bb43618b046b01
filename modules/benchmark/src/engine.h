#pragma once
// Snakemake, started on share/workflow/Snakefile with the plan of a benchmark.
#include <string>

#include "edgevo/benchmark/bench_run.h"

namespace edgevo {

/// `workflow`: folder of plan.json. Shows a line of progress; what Snakemake says goes into engine.log there
/// (a dry run: to stdout). SIGINT and SIGTERM end it and its jobs. Returns an empty text, or why it did not
/// do all, in a line. Throws InputError: it is not installed, its files are not there.
std::string run_engine(const std::string& workflow, const EngineOptions& options, const BenchHost& host);

}  // namespace edgevo
