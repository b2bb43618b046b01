#include "depth_evidence.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kBorderPx = 3;      // edges nearer to the image's border may be cut off
constexpr double kMinDepth = 0.05;   // of a point over its depth in the host: nearer is beside the camera
// From the projected point to the edge, across it: in the first two looks the depth is not yet exact.
constexpr double kReachPx[] = {3.0, 2.0, 1.25};
constexpr int kLooks = 3;
constexpr double kAlongPx = 2.5;     // from the point to the nearest edge pixel, any direction, plus the reach
constexpr float kSidePx = 2;        // off the edge: outside the blur of the step itself
constexpr float kGrayTolerance = 12;   // gray levels: noise, and texture beside the edge
constexpr float kGrayShare = 0.4f;     // of the step: a side differs when it is off by more
// Pixels across the edge that a point would move were it infinitely far: below, a view tells no depth.
constexpr double kMinMotionPx = 3;

// One view's equation for the inverse depth.
struct Look {
  bool in_view = false, found = false;
  double residual = 0, slope = 0;  // r and J
  SideChange change;
};

Look look_up(const EdgeSight& sight, const ViewGeometry& view, const SightLine& line, double idepth,
             double reach) {
  Look look;
  if (!(line.depth(idepth) > kMinDepth)) return look;
  const Eigen::Vector2d p = line.at(idepth);
  if (!view.level->pinhole.contains(p, kBorderPx)) return look;
  look.in_view = true;
  const int j = view.level->field.nearest(float(p.x()), float(p.y()));
  if (j < 0) return look;
  const EdgePixel& e = view.level->edges.pixels[size_t(j)];
  const Eigen::Vector2d offset = e.position().cast<double>() - p;
  const Eigen::Vector2d n = e.normal().cast<double>();
  look.residual = n.dot(offset);
  if (std::abs(look.residual) > reach || offset.squaredNorm() > (kAlongPx + reach) * (kAlongPx + reach)) return look;
  if (!is_like_direction(view, sight.normal, e)) return look;
  look.change = compare_sides(sight.sides, view, size_t(j));
  if (look.change.dark && look.change.bright) return look;
  look.found = true;
  look.slope = n.dot(line.slope(idepth, p));
  return look;
}

}  // namespace

std::vector<EdgeSides> sample_sides(const PyramidLevel& level) {
  const Plane<uint8_t>& gray = level.gray;
  const auto at = [&](float x, float y) {
    return gray.at(std::clamp(int(x + 0.5f), 0, gray.width() - 1), std::clamp(int(y + 0.5f), 0, gray.height() - 1));
  };
  std::vector<EdgeSides> sides;
  sides.reserve(level.edges.pixels.size());
  for (const EdgePixel& e : level.edges.pixels)
    sides.push_back({at(e.x - kSidePx * e.nx, e.y - kSidePx * e.ny), at(e.x + kSidePx * e.nx, e.y + kSidePx * e.ny)});
  return sides;
}

SideChange compare_sides(const EdgeSides& host, const ViewGeometry& view, size_t e) {
  const EdgeSides& there = (*view.sides)[e];
  const float tolerance = kGrayTolerance + kGrayShare * float(host.bright - host.dark);
  const float share = 1 / float(view.gain);
  return {std::abs(float(there.dark) * share - float(host.dark)) > tolerance,
          std::abs(float(there.bright) * share - float(host.bright)) > tolerance};
}

Hypothesis weigh(const EdgeSight& sight, const std::vector<ViewGeometry>& views, double idepth, Guess guess,
                 double max_idepth, const EdgeMapParams& params) {
  Hypothesis h;
  for (int pass = guess == Guess::kRough ? 0 : 1; pass < kLooks; ++pass) {
    h = Hypothesis{};
    h.idepth = idepth;
    double A = 0, b = 0;  // of A (rho - idepth) = b
    for (size_t v = 0; v < views.size() && h.in_view < params.views; ++v) {
      const Look look = look_up(sight, views[v], sight.lines[v], idepth, kReachPx[pass]);
      h.in_view += look.in_view;
      if (!look.found) {
        h.cost += look.in_view;
        continue;
      }
      A += look.slope * look.slope;
      b += look.slope * look.residual;
      ++h.views;
      h.informative += std::abs(look.slope) * idepth >= kMinMotionPx;
      h.cost += std::min(1.0, std::pow(look.residual / kReachPx[kLooks - 1], 2));
      h.dark_differs += look.change.dark, h.bright_differs += look.change.bright;
    }
    h.information = A / (params.sigma_px * params.sigma_px);
    if (h.views < params.min_views) return h;
    if (pass < kLooks - 1 && A > 0) idepth = std::clamp(idepth + b / A, 0.0, max_idepth);
  }
  return h;
}

}  // namespace edgevo
