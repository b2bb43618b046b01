// SPDX-License-Identifier: BSD-3-Clause
#include "depth_evidence.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kMinDepth = 0.05;  // of a point over its depth in the host: nearer is next to the camera
// From the projected point to the edge, across it: in the first two passes the depth is not yet exact.
constexpr double kReachPx[] = {3.0, 2.0, 1.25};
constexpr int kLooks = 3;
constexpr double kAlongPx = 2.5;  // from the point to the nearest edge pixel, any direction, plus the reach
constexpr float kSidePx = 2;      // off the edge: outside the blur of the step itself
constexpr float kGrayTolerance = 12;  // gray levels: noise, and texture next to the edge
constexpr float kGrayShare = 0.4f;    // of the step: a side differs when it is off by more
// Motion across the edge from infinity to the depth of the point, below which a view does not constrain
// depth.
constexpr double kMinMotionPx = 3;

// One view's equation for the inverse depth.
struct Look {
  size_t view = 0;
  Eigen::Vector2d p;  // position of the point in the view
  int pixel = -1;     // pixel of the nearest edge
  bool found = false;
  double residual = 0, slope = 0;  // r and J
  SideChange change;
};

// The first `most` views that contain the point. Memory is prefetched, since the look-ups are scattered over
// a megabyte.
void project(const EdgeSight& sight, const std::vector<ViewGeometry>& views, double idepth, int most,
             std::vector<Look>* looks) {
  looks->clear();
  for (size_t v = 0; v < views.size() && int(looks->size()) < most; ++v) {
    const SightLine& line = sight.lines[v];
    if (!(line.depth(idepth) > kMinDepth)) continue;
    Look look;
    look.view = v;
    look.p = line.at(idepth);
    if (!views[v].level->pinhole.contains(look.p, kEdgeBorderPx)) continue;
    views[v].level->field.prefetch_pixel(float(look.p.x()), float(look.p.y()));
    looks->push_back(look);
  }
  for (Look& look : *looks) {
    const NearestField& field = views[look.view].level->field;
    look.pixel = field.nearest_pixel(float(look.p.x()), float(look.p.y()));
    if (look.pixel >= 0) field.prefetch_edge(look.pixel);
  }
}

void compare_with_edge(const EdgeSight& sight, const ViewGeometry& view, double idepth, double reach,
                       Look* look) {
  if (look->pixel < 0) return;
  const size_t j = size_t(view.level->field.edge_at(look->pixel));
  const EdgePixel& e = view.level->edges.pixels[j];
  const Eigen::Vector2d offset = e.position().cast<double>() - look->p;
  const Eigen::Vector2d n = e.normal().cast<double>();
  look->residual = n.dot(offset);
  if (std::abs(look->residual) > reach || offset.squaredNorm() > (kAlongPx + reach) * (kAlongPx + reach))
    return;
  if (!is_like_direction(view, sight.normal, e)) return;
  look->change = compare_sides(sight.sides, view, j);
  look->found = !(look->change.dark && look->change.bright);
  look->slope = n.dot(sight.lines[look->view].slope(idepth, look->p));
}

}  // namespace

std::vector<EdgeSides> sample_sides(const PyramidLevel& level) {
  const Plane<uint8_t>& gray = level.gray;
  const auto at = [&](float x, float y) {
    return gray.at(std::clamp(int(x + 0.5f), 0, gray.width() - 1),
                   std::clamp(int(y + 0.5f), 0, gray.height() - 1));
  };
  std::vector<EdgeSides> sides;
  sides.reserve(level.edges.pixels.size());
  for (const EdgePixel& e : level.edges.pixels)
    sides.push_back(
        {at(e.x - kSidePx * e.nx, e.y - kSidePx * e.ny), at(e.x + kSidePx * e.nx, e.y + kSidePx * e.ny)});
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
  thread_local std::vector<Look> looks;
  Hypothesis h;
  for (int pass = guess == Guess::kRough ? 0 : 1; pass < kLooks; ++pass) {
    h = Hypothesis{};
    h.idepth = idepth;
    double A = 0, b = 0;  // of A (rho - idepth) = b
    project(sight, views, idepth, params.views, &looks);
    h.in_view = int(looks.size());
    for (Look& look : looks) {
      compare_with_edge(sight, views[look.view], idepth, kReachPx[pass], &look);
      if (!look.found) {
        h.cost += 1;
        continue;
      }
      A += look.slope * look.slope;
      b += look.slope * look.residual;
      ++h.views;
      h.informative += std::abs(look.slope) * idepth >= kMinMotionPx;
      h.cost += std::min(1.0, std::pow(look.residual / kReachPx[kLooks - 1], 2));
      h.dark_differs += look.change.dark, h.bright_differs += look.change.bright;
    }
    h.information = A / (kEdgeSigmaPx * kEdgeSigmaPx);
    if (h.views < params.min_views) return h;
    if (pass < kLooks - 1 && A > 0) idepth = std::clamp(idepth + b / A, 0.0, max_idepth);
  }
  return h;
}

}  // namespace edgevo
