// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The folders that `edgevo compare` is given, as the rows of its page.
#include <string>
#include <vector>

#include "edgevo/report/compare_page.h"

namespace edgevo {

/// All runs at or below `paths` (find_runs), each once. A run is named by the part of its path that the
/// others do not share; links are relative to the folder of `page`. `ground_truth` is a file for all of them;
/// empty: each run's own. Throws InputError: no run, none that can be compared, or a ground truth that is not
/// a trajectory.
std::vector<ComparedRun> compared_runs(const std::vector<std::string>& paths, const std::string& ground_truth,
                                       const std::string& page);

}  // namespace edgevo
