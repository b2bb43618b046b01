#pragma once
// CPU times of a run by stage, for frames.csv, summary.yaml and report.html.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Names of the stages in the order in which they first ran.
std::vector<std::string> stages_of(const Run& run);
/// For each of them the milliseconds of the frames in which it ran.
std::vector<std::pair<std::string, std::vector<double>>> stage_times(const Run& run);
/// For each frame the sum of its stages, milliseconds.
std::vector<double> total_ms(const Run& run);
/// Smallest value that `share` of the sorted values do not exceed (nearest rank). `sorted` is not empty.
double percentile(const std::vector<double>& sorted, double share);

}  // namespace edgevo
