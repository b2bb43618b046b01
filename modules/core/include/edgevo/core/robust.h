// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Robust weights for iteratively re-weighted least squares. `r` and `width` share one unit (pixels or
// sigmas).
#include <cmath>

namespace edgevo {

/// Huber's weight: 1 inside `width`, width/|r| outside.
inline double huber_weight(double r, double width) {
  const double a = std::abs(r);
  return a <= width ? 1.0 : width / a;
}
/// Huber's cost rho(r) whose derivative is huber_weight(r) r.
inline double huber_cost(double r, double width) {
  const double a = std::abs(r);
  return a <= width ? 0.5 * r * r : width * (a - 0.5 * width);
}

}  // namespace edgevo
