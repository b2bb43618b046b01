#include "edgevo/scale/sliding_scale.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kKnotsPerStretch = 10;  // estimates from stretches that share nine tenths differ by little

struct Knot {
  double way;
  ScaleEstimate scale;
};

ScaleEstimate between(const Knot& a, const Knot& b, double way) {
  const double share = (way - a.way) / (b.way - a.way);
  const auto mix = [&](double x, double y) { return (1 - share) * x + share * y; };
  return {mix(a.scale.factor, b.scale.factor), mix(a.scale.sigma, b.scale.sigma),
          std::min(a.scale.samples, b.scale.samples)};
}

ScaleEstimate at(const std::vector<Knot>& knots, double way) {
  const auto next =
      std::upper_bound(knots.begin(), knots.end(), way, [](double w, const Knot& k) { return w < k.way; });
  if (next == knots.begin()) return knots.front().scale;
  if (next == knots.end()) return knots.back().scale;
  return between(*(next - 1), *next, way);
}

}  // namespace

std::vector<ScaleEstimate> slide(const Path& path, double stretch, const FitStretch& fit) {
  std::vector<ScaleEstimate> scales;
  if (path.empty()) return scales;
  const double whole = path.back().way;
  const auto overall = fit(0, whole);
  // How long the stretch is in units of the run; the whole path while nothing is known or it is shorter.
  const double length = overall ? std::min(stretch / overall->factor, whole) : whole;
  const int steps = length > 0 ? int(std::ceil(kKnotsPerStretch * whole / length)) : 0;
  std::vector<Knot> knots;
  for (int i = 0; i <= steps; ++i) {
    const double way = steps > 0 ? whole * i / steps : 0;
    const double begin = std::clamp(way - length / 2, 0.0, std::max(0.0, whole - length));
    if (const auto estimate = fit(begin, begin + length)) knots.push_back({way, *estimate});
  }
  if (knots.empty() && overall) knots.push_back({0, *overall});
  if (knots.empty()) return scales;
  for (const PathPose& pose : path) scales.push_back(at(knots, pose.way));
  return scales;
}

}  // namespace edgevo
