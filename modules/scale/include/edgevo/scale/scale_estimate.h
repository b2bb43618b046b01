#pragma once
#include <vector>

namespace edgevo {

/// How long a unit of the run is, near some place of its way.
struct ScaleEstimate {
  double factor = 1;  ///< metres per unit, > 0
  double sigma = 0;   ///< relative, one standard deviation
  int samples = 0;    ///< that it rests on
};

/// How many independent values a series of residuals is worth: n (1 - rho) / (1 + rho), rho its correlation
/// from one value to the next, not below 0. At least 1.
double effective_count(const std::vector<double>& residuals);

}  // namespace edgevo
