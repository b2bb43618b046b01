// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Mean of independent values and how well it is known.
#include <cmath>
#include <vector>

namespace edgevo {

/// Mean and its standard error, in the unit of the values. Error 0: of fewer than two values it is not known.
struct MeanAndError {
  double mean = 0, error = 0;
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
