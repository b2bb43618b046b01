// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Means over the pairs of a cell, and whether two cells differ by more than chance.
#include <string>

#include "edgevo/study/study.h"

namespace edgevo {

struct CellStatistics {
  int pairs = 0, failed = 0;
  /// Drift in per cent, a failure counting 100: mean, standard error of the mean, median.
  double drift_mean = 0, drift_error = 0, drift_median = 0;
  // The following are over the pairs that did not fail.
  double rotation_mean_deg = 0, direction_mean_deg = 0;
  /// Mean number of matches in a pair.
  double matches = 0, photometric = 0;
  double wrong_share = 0, median_px = 0;
  double match_ms = 0, solve_ms = 0, track_ms = 0;
};
CellStatistics statistics(const StudyCell& cell);

/// Mean and standard error of the drift of `a` minus that of `b`, pair by pair, per cent.
struct Difference {
  double mean = 0, error = 0;
  bool is_clear() const { return std::abs(mean) > 2 * error; }
};
Difference drift_difference(const StudyCell& a, const StudyCell& b);

/// The cell of that curve, light, method and setting. Throws std::logic_error if the study has none.
const StudyCell& find_cell(const StudyResult& result, const std::string& curve, const std::string& light,
                           const std::string& method, const std::string& setting);

}  // namespace edgevo
