// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/adaptive_threshold.h"

#include <algorithm>

namespace edgevo {

double high_threshold(const Plane<float>& magnitude, const EdgeParams& params) {
  // Share of the largest gradient: edges of equal strength stay above it, despite their noise.
  constexpr double kShareOfPeak = 0.7;
  const GradientHistogram histogram(magnitude);
  const double percentile = histogram.percentile(params.canny_percentile), peak = histogram.percentile(1.0);
  return std::max(std::min(percentile, kShareOfPeak * peak), params.min_gradient * kSobelPerGrayLevel);
}

}  // namespace edgevo
