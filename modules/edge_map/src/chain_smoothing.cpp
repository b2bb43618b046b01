// SPDX-License-Identifier: BSD-3-Clause
#include "chain_smoothing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace edgevo {
namespace {

// Edge pixels within this distance along the edge share their error: the detector's filter is five pixels
// wide.
constexpr double kCorrelatedPx = 3;
constexpr double kReachesPx[] = {64, 32, 16, 8};  // in each direction, the longest first
constexpr double kMaxVariance = 2;  // of the residuals over the expected one: above it the edge bends

// Sums over values: of weights, and of weights times products of position and value.
struct Sums {
  double w = 0, x = 0, xx = 0, y = 0, xy = 0, yy = 0;
  double common = 0;  // of weights times squared common errors

  void add(double weight, double at, double value, double common_error) {
    w += weight, x += weight * at, xx += weight * at * at;
    y += weight * value, xy += weight * at * value, yy += weight * value * value;
    common += weight * common_error * common_error;
  }
  Sums operator-(const Sums& o) const {
    return {w - o.w, x - o.x, xx - o.xx, y - o.y, xy - o.xy, yy - o.yy, common - o.common};
  }
};

struct LineFit {
  bool valid = false;
  double value = 0, variance = 0;  // at the requested position
  double residual = 0;             // weighted sum of squares
};

double weight_of(const ChainValue& v) { return v.variance > 0 ? 1 / (v.variance + v.common * v.common) : 0; }

LineFit fit_line(const Sums& s, double at) {
  LineFit fit;
  const double xx = s.xx - s.x * s.x / s.w, xy = s.xy - s.x * s.y / s.w, yy = s.yy - s.y * s.y / s.w;
  if (!(s.w > 0) || !(xx > 1e-9 * s.w)) return fit;
  const double slope = xy / xx, off = at - s.x / s.w;
  fit.value = s.y / s.w + slope * off;
  fit.variance = 1 / s.w + off * off / xx;
  fit.residual = std::max(0.0, yy - slope * xy);
  fit.valid = true;
  return fit;
}

}  // namespace

std::vector<SmoothValue> smooth_chain(const std::vector<ChainValue>& values) {
  const size_t n = values.size();
  std::vector<SmoothValue> smooth(n);
  if (n == 0) return smooth;
  // Relative to the first value: the sums stay small, and their differences exact.
  std::vector<Sums> until(n + 1);
  for (size_t i = 0; i < n; ++i) {
    until[i + 1] = until[i];
    until[i + 1].add(weight_of(values[i]), values[i].at - values[0].at, values[i].value - values[0].value,
                     values[i].common);
  }
  const double spacing = (values[n - 1].at - values[0].at) / double(std::max<size_t>(1, n - 1));
  const double correlated = std::max(1.0, kCorrelatedPx / std::max(spacing, 1e-3));
  for (size_t i = 0; i < n; ++i) {
    smooth[i] = {values[i].value, std::sqrt(values[i].variance + values[i].common * values[i].common)};
    for (const double reach : kReachesPx) {
      const auto first = std::lower_bound(values.begin(), values.end(), values[i].at - reach,
                                          [](const ChainValue& v, double at) { return v.at < at; });
      const auto last = std::upper_bound(values.begin(), values.end(), values[i].at + reach,
                                         [](double at, const ChainValue& v) { return at < v.at; });
      const size_t begin = size_t(first - values.begin()), end = size_t(last - values.begin());
      if (end - begin < 3) break;
      const Sums within = until[end] - until[begin];
      const LineFit fit = fit_line(within, values[i].at - values[0].at);
      if (!fit.valid) continue;
      const double freedom = double(end - begin) - 2;
      if (fit.residual > kMaxVariance * freedom && reach > kReachesPx[std::size(kReachesPx) - 1]) continue;
      smooth[i] = {values[0].value + fit.value,
                   std::sqrt(correlated * fit.variance * std::max(1.0, fit.residual / freedom) +
                             within.common / within.w)};
      break;
    }
  }
  return smooth;
}

}  // namespace edgevo
