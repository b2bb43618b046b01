#pragma once
// Inverse depths along a piece of an edge, made smooth.
#include <vector>

namespace edgevo {

/// A value at a place along the edge.
struct ChainValue {
  double at = 0, value = 0;
  double variance = 0;  ///< of an error of its own; 0: it has no information
  double common = 0;    ///< standard deviation of an error that it shares with its neighbours
};

struct SmoothValue {
  double value = 0, sigma = 0;
};

/// At each place the value of a straight line fitted to its neighbours, as far to both sides as a straight
/// line describes them, and its standard deviation; places without information get it, too. Ascending `at`.
/// Cost: linear.
std::vector<SmoothValue> smooth_chain(const std::vector<ChainValue>& values);

}  // namespace edgevo
