// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Medians and quantiles of small sets of measurements.
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace edgevo {

/// Value of rank `rank`, 0 <= rank < size, 0 being the smallest. O(size).
template <class T>
T of_rank(std::vector<T> values, size_t rank) {
  const auto at = values.begin() + std::ptrdiff_t(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Median, the larger of the middle two for an even size; 0 for no values. O(size).
template <class T>
T median(std::vector<T> values) {
  const size_t middle = values.size() / 2;
  return values.empty() ? T(0) : of_rank(std::move(values), middle);
}

/// Quantile: the value that `share` (0 to 1) of the others do not exceed; 0 for no values. O(size).
template <class T>
T quantile(std::vector<T> values, double share) {
  if (values.empty()) return T(0);
  const auto rank = size_t(share * double(values.size() - 1));
  return of_rank(std::move(values), rank);
}

}  // namespace edgevo
