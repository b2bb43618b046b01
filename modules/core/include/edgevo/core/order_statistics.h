#pragma once
// Medians and quantiles of small sets of measurements.
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace edgevo {

/// The value of rank 0 <= `rank` < size, 0 being the smallest. O(size).
template <class T>
T of_rank(std::vector<T> values, size_t rank) {
  const auto at = values.begin() + std::ptrdiff_t(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The middle value, the larger one where two are in the middle; 0 of none. O(size).
template <class T>
T median(std::vector<T> values) {
  const size_t middle = values.size() / 2;
  return values.empty() ? T(0) : of_rank(std::move(values), middle);
}

/// The value that `share` (0..1) of the others are not above; 0 of none. O(size).
template <class T>
T quantile(std::vector<T> values, double share) {
  if (values.empty()) return T(0);
  const auto rank = size_t(share * double(values.size() - 1));
  return of_rank(std::move(values), rank);
}

}  // namespace edgevo
