// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/scale_estimate.h"

#include <algorithm>

namespace edgevo {

double effective_count(const std::vector<double>& residuals) {
  // At this value a hundredth of the values count; a short series cannot distinguish it from 1.
  constexpr double kMaxCorrelation = 0.98;
  double squares = 0, products = 0;
  for (size_t i = 0; i < residuals.size(); ++i) {
    squares += residuals[i] * residuals[i];
    if (i > 0) products += residuals[i] * residuals[i - 1];
  }
  const double rho = squares > 0 ? std::clamp(products / squares, 0.0, kMaxCorrelation) : 0.0;
  return std::max(1.0, double(residuals.size()) * (1 - rho) / (1 + rho));
}

}  // namespace edgevo
