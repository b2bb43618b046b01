// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <numeric>
#include <vector>

#include "edgevo/core/order_statistics.h"

namespace edgevo {

/// The newest values of a measurement. Unknown ones (NaN) are skipped.
class RecentValues {
 public:
  /// Keeps `most` values.
  explicit RecentValues(size_t most) : most_(most) {}

  /// Adds a value; one that is not finite is skipped.
  void add(double value) {
    if (!std::isfinite(value)) return;
    values_.push_back(value);
    if (values_.size() > most_) values_.pop_front();
  }
  /// Forgets all values.
  void clear() { values_.clear(); }
  /// Number of values kept.
  size_t size() const { return values_.size(); }

  /// Mean of the newest `count` values, of all by default; NaN if there are none.
  double mean(size_t count = std::numeric_limits<size_t>::max()) const {
    const size_t n = std::min(count, values_.size());
    if (n == 0) return std::numeric_limits<double>::quiet_NaN();
    return std::accumulate(values_.end() - std::ptrdiff_t(n), values_.end(), 0.0) / double(n);
  }
  /// Median of all values; NaN for fewer than `fewest`. Cost: linear.
  double median(size_t fewest = 10) const {
    if (values_.size() < fewest) return std::numeric_limits<double>::quiet_NaN();
    return edgevo::median(std::vector<double>(values_.begin(), values_.end()));
  }
  /// The value that `share`, 0 to 1, of the others do not exceed; NaN for fewer than `fewest`. Cost: linear.
  double quantile(double share, size_t fewest = 10) const {
    if (values_.size() < fewest) return std::numeric_limits<double>::quiet_NaN();
    return edgevo::quantile(std::vector<double>(values_.begin(), values_.end()), share);
  }

 private:
  size_t most_;
  std::deque<double> values_;
};

}  // namespace edgevo
