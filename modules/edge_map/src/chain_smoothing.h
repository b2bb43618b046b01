// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Smoothing of inverse depths along a piece of an edge.
#include <vector>

namespace edgevo {

/// Value at a position along the edge.
struct ChainValue {
  /// Position along the edge, pixels, and value.
  double at = 0, value = 0;
  /// Variance of the independent error; 0 if the value carries no information.
  double variance = 0;
  /// Standard deviation of the error that it shares with its neighbours.
  double common = 0;
};

/// Smoothed value with its standard deviation.
struct SmoothValue {
  double value = 0, sigma = 0;
};

/// Fits a straight line around each position, as far in both directions as a line describes the values, and
/// evaluates it there. Positions without information get a value too. `values` ascend in `at`. Cost: linear.
std::vector<SmoothValue> smooth_chain(const std::vector<ChainValue>& values);

}  // namespace edgevo
