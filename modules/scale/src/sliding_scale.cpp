// SPDX-License-Identifier: BSD-3-Clause
#include "sliding_scale.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kKnotsPerInterval = 10;  // estimates from intervals that share nine tenths differ little

struct Knot {
  double distance;
  ScaleEstimate scale;
};

ScaleEstimate between(const Knot& a, const Knot& b, double distance) {
  const double share = (distance - a.distance) / (b.distance - a.distance);
  const auto mix = [&](double x, double y) { return (1 - share) * x + share * y; };
  return {mix(a.scale.factor, b.scale.factor), mix(a.scale.sigma, b.scale.sigma),
          std::min(a.scale.samples, b.scale.samples)};
}

ScaleEstimate at(const std::vector<Knot>& knots, double distance) {
  const auto next = std::upper_bound(knots.begin(), knots.end(), distance,
                                     [](double w, const Knot& k) { return w < k.distance; });
  if (next == knots.begin()) return knots.front().scale;
  if (next == knots.end()) return knots.back().scale;
  return between(*(next - 1), *next, distance);
}

}  // namespace

std::vector<ScaleEstimate> slide(const Path& path, double interval, const FitInterval& fit) {
  std::vector<ScaleEstimate> scales;
  if (path.empty()) return scales;
  const double whole = path.back().distance;
  const auto overall = fit(0, whole);
  // Length of the interval in units of the run; the whole path if no scale is known or the path is shorter.
  const double length = overall ? std::min(interval / overall->factor, whole) : whole;
  const int steps = length > 0 ? int(std::ceil(kKnotsPerInterval * whole / length)) : 0;
  std::vector<Knot> knots;
  for (int i = 0; i <= steps; ++i) {
    const double distance = steps > 0 ? whole * i / steps : 0;
    const double begin = std::clamp(distance - length / 2, 0.0, std::max(0.0, whole - length));
    if (const auto estimate = fit(begin, begin + length)) knots.push_back({distance, *estimate});
  }
  if (knots.empty() && overall) knots.push_back({0, *overall});
  if (knots.empty()) return scales;
  for (const PathPose& pose : path) scales.push_back(at(knots, pose.distance));
  return scales;
}

}  // namespace edgevo
