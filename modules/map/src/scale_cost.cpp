// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/scale_cost.h"

#include <algorithm>
#include <cmath>

namespace edgevo {

// r^2 / s^2, or with the failure  r^2 / f^2 + ln f^2 - ln s^2 + 2 ln((1 - p) / p).
double scale_cost(const Constraint& c, double residual) {
  const double square = residual * residual, held = square / c.covariance(6, 6);
  if (!c.failure || c.failure->probability == 0) return held;
  const double failed = c.failure->covariance(6, 6), p = c.failure->probability;
  return std::min(held, square / failed + std::log(failed / c.covariance(6, 6)) + 2 * std::log((1 - p) / p));
}

}  // namespace edgevo
