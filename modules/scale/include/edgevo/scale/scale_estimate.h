// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

namespace edgevo {

/// Length of a unit of the run near one position on its path.
struct ScaleEstimate {
  /// Metres per unit, > 0.
  double factor = 1;
  /// Standard deviation of the factor, relative to it.
  double sigma = 0;
  /// Number of measurements the estimate rests on.
  int samples = 0;
};

/// Number of independent values that a series of residuals is worth: n (1 - rho) / (1 + rho), where rho >= 0
/// is the correlation of successive values. At least 1.
double effective_count(const std::vector<double>& residuals);

}  // namespace edgevo
