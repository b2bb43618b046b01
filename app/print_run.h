// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/core/records.h"

namespace edgevo::app {

/// Prints the counts of a run and the folder of its results to stdout, warnings to stderr.
void print_run(const Run& run, const std::string& out, bool include_doubtful = false);

}  // namespace edgevo::app
