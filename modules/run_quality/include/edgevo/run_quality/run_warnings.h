// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Warnings that a user must see before using the results of a run: on the console, at the top of the report,
// in summary.yaml.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Whether the estimate of k1 ran into that limit, be it applied or not.
bool ran_to_limit(const CameraRefinement& camera);

/// Warnings about the run, one sentence each; empty if there are none.
std::vector<std::string> run_warnings(const Run& run);

}  // namespace edgevo
