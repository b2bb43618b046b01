#pragma once
// The folders that `edgevo compare` is given as the rows of its page.
#include <string>
#include <vector>

#include "edgevo/report/compare_page.h"

namespace edgevo {

/// All runs at or below `paths` (find_runs), each once; named by what their folders do not share, linked
/// relative to the folder of `page`. `ground_truth`: a file for all of them; empty: what each run noted.
/// Throws InputError: no run there, none that can be compared, a ground truth that is no trajectory.
std::vector<ComparedRun> compared_runs(const std::vector<std::string>& paths, const std::string& ground_truth,
                                       const std::string& page);

}  // namespace edgevo
