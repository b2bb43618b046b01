// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/core/records.h"

namespace edgevo::app {

/// Prints the counts of a run and the folder of its results to stdout, warnings to stderr.
void print_run(const Run& run, const std::string& out, bool include_doubtful = false);

/// The exit code of a finished run: 0, or 3 where most of its frames have no pose, or too many poses are
/// doubtful (RunCounts), which is said in one line on stderr with the commonest reason. `earlier`: folder in
/// which the files of the previous run are kept; empty: none.
int print_failure(const Run& run, const std::string& what, const std::string& earlier = {});

}  // namespace edgevo::app
