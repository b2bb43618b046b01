// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Warnings that a user must see before using the results of a run: on the console, at the top of the report,
// in summary.yaml.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Warnings about the run, one sentence each; empty if there are none.
std::vector<std::string> run_warnings(const Run& run);

}  // namespace edgevo
