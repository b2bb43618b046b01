#pragma once
// Robust weights for iteratively re-weighted least squares. `r` and the widths share one unit (pixels or
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
/// Degrees of freedom: tails as residuals of images have them (Kerl, Sturm, Cremers 2013).
constexpr double kStudentFreedom = 5.0;

/// Student-t weight with `dof` degrees of freedom and scale sigma: (dof + 1) / (dof + (r/sigma)^2).
inline double student_t_weight(double r, double sigma, double dof = kStudentFreedom) {
  const double x = r / sigma;
  return (dof + 1.0) / (dof + x * x);
}
/// Student-t cost, whose derivative is student_t_weight(r) r / sigma^2.
inline double student_t_cost(double r, double sigma, double dof = kStudentFreedom) {
  return 0.5 * (dof + 1.0) * std::log1p(r * r / (dof * sigma * sigma));
}

}  // namespace edgevo
