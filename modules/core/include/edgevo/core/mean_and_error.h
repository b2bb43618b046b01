// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Mean of independent values and how well it is known.
#include <cmath>
#include <vector>

namespace edgevo {

/// A mean and how well it is known, in the unit of the values.
struct MeanAndError {
  /// The mean.
  double mean = 0;
  /// Its standard error; 0 of fewer than two values: not known.
  double error = 0;
};

/// Of values that are independent of each other; zeros without values.
inline MeanAndError mean_and_error(const std::vector<double>& values) {
  MeanAndError m;
  const double n = double(values.size());
  for (const double v : values) m.mean += v / n;
  double square = 0;
  for (const double v : values) square += (v - m.mean) * (v - m.mean);
  m.error = n > 1 ? std::sqrt(square / (n - 1) / n) : 0;
  return m;
}

}  // namespace edgevo
