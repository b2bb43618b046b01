#pragma once
// Robust weights for iteratively re-weighted least squares. `r` and the widths share one unit (pixels or sigmas).
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
/// Student-t weight with `dof` degrees of freedom and scale sigma: (dof + 1) / (dof + (r/sigma)^2).
inline double student_t_weight(double r, double sigma, double dof = 5.0) {
  const double x = r / sigma;
  return (dof + 1.0) / (dof + x * x);
}

}  // namespace edgevo
