// SPDX-License-Identifier: BSD-3-Clause
#include "false_alarms.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

double log_choose(int n, int k) {
  return (std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0)) / std::log(10.0);
}

}  // namespace

double log_alarms_of_corners(int pairs, int agreeing, double chance) {
  if (agreeing <= 3) return std::log10(double(std::max(1, pairs)));
  return std::log10(double(pairs - 3)) + log_choose(pairs, agreeing) + log_choose(agreeing, 3) +
         (agreeing - 3) * std::log10(chance);
}

double log_alarms_of_share(int edges, double share, double chance) {
  constexpr double kLeast = 1e-3;
  const double s = std::clamp(share, kLeast, 1 - kLeast), c = std::clamp(chance, kLeast, 1 - kLeast);
  if (!(s > c)) return 0;
  const double divergence = s * std::log(s / c) + (1 - s) * std::log((1 - s) / (1 - c));
  return -edges * divergence / std::log(10.0);
}

}  // namespace edgevo
