// SPDX-License-Identifier: BSD-3-Clause
#include "epipolar_crossings.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr double kMinLengthPx = 6;    // shorter lines do not separate neighbouring edges
constexpr double kMaxLengthPx = 400;  // on a longer one, all edges of the image would be candidates
constexpr double kMinDepth = 0.1;     // as in depth_evidence.cpp, with a margin
constexpr double kNearPx = 1.5;       // an edge pixel this close to the line is tried
constexpr double kMaxSlidePx = 3;     // from there to the crossing of edge and line
constexpr double kMinCrossing = 0.2;  // sine of the angle between edge and line: 12 degrees
constexpr double kStepPast = 1.5;     // pixels beyond a crossing: closer ones belong to the same edge

// The part of p(0..max_idepth) within the image, as start + s direction, 0 <= s <= length.
struct Segment {
  Eigen::Vector2d start, direction;
  double length = 0;
};

Segment visible_segment(const Pinhole& c, const SightLine& line, double max_idepth) {
  Segment s;
  if (!(line.depth(0) > kMinDepth)) return s;
  double high = max_idepth;
  if (line.depth(high) < kMinDepth) high = (kMinDepth - line.h.z()) / line.e.z();
  s.start = line.at(0);
  const Eigen::Vector2d span = line.at(high) - s.start;
  const double length = span.norm();
  if (length < kMinLengthPx) return s;
  s.direction = span / length;
  double from = 0, to = length;
  const double last[2] = {c.width - 1 - kEdgeBorderPx, c.height - 1 - kEdgeBorderPx};
  for (int axis = 0; axis < 2; ++axis) {
    const double p = s.start[axis], d = s.direction[axis];
    if (std::abs(d) < 1e-9) {
      if (p < kEdgeBorderPx || p > last[axis]) to = -1;
      continue;
    }
    const double a = (kEdgeBorderPx - p) / d, b = (last[axis] - p) / d;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (to - from < kMinLengthPx) return s;
  s.start += from * s.direction;
  s.length = std::min(to - from, kMaxLengthPx);
  return s;
}

// Position at which the line crosses the tangent of an edge pixel; negative if it does not do so nearby.
// `normal`: that of the host's edge, as seen in the view.
double crossing(const EdgeSight& sight, const ViewGeometry& view, const Eigen::Vector2d& normal,
                const Segment& segment, double s, size_t j) {
  const EdgePixel& e = view.level->edges.pixels[j];
  if (!is_like_direction(normal.x(), normal.y(), e)) return -1;
  const Eigen::Vector2d n = e.normal().cast<double>();
  const double sine = n.dot(segment.direction);
  if (std::abs(sine) < kMinCrossing) return -1;
  const double at = n.dot(e.position().cast<double>() - segment.start) / sine;
  if (std::abs(at - s) > kMaxSlidePx) return -1;
  const SideChange change = compare_sides(sight.sides, view, j);
  return change.dark && change.bright ? -1 : at;
}

// An edge next to the line.
struct NearEdge {
  double s;  // position on the line
  int at;    // first its pixel, then its edge pixel
};

// The pixels of the points of a segment.
constexpr size_t kMostSteps = size_t(kMaxLengthPx / kStepPast) + 1;
struct Walk {
  size_t count = 0;
  int column[kMostSteps], row[kMostSteps];
};

EDGEVO_WIDE_CLONES void step_along(const Segment& segment, Walk* walk) {
  const double x = segment.start.x(), y = segment.start.y(), dx = segment.direction.x(),
               dy = segment.direction.y();
  const size_t count = size_t(segment.length / kStepPast) + 1;
  for (size_t i = 0; i < count; ++i) {
    const double s = kStepPast * double(int(i));
    walk->column[i] = int(float(x + s * dx) + 0.5f), walk->row[i] = int(float(y + s * dy) + 0.5f);
  }
  walk->count = count;
}

// The edges next to the line, in its order; all of it lies in the image. Even steps, as no read waits for
// another: longer ones where no edge is near take as long.
void walk_along(const NearestField& field, const Segment& segment, std::vector<NearEdge>* near) {
  constexpr int kNearSquared = int(kNearPx * kNearPx);
  Walk walk;
  step_along(segment, &walk);
  for (size_t i = 0; i < walk.count; ++i) {
    const int x = walk.column[i], y = walk.row[i];
    if (field.squared_distance_at(x, y) > kNearSquared) continue;
    near->push_back({kStepPast * double(i), field.nearest_pixel(float(x), float(y))});
    field.prefetch_edge(near->back().at);
  }
}

void add_crossings(const EdgeSight& sight, const ViewGeometry& view, const SightLine& line,
                   const Segment& segment, const std::vector<NearEdge>& near, double max_idepth,
                   std::vector<double>* idepths) {
  const Eigen::Vector2d normal = view.turn * sight.normal;
  double last = -kStepPast;
  for (const NearEdge& e : near) {
    const double at = crossing(sight, view, normal, segment, e.s, size_t(e.at));
    if (at < 0 || at > segment.length || at <= last + kStepPast) continue;
    const double idepth = line.idepth_at(segment.start + at * segment.direction, segment.direction);
    if (idepth > 0 && idepth <= max_idepth) idepths->push_back(idepth);
    last = at;
  }
}

}  // namespace

bool find_crossings(const EdgeSight& sight, const ViewGeometry& view, double max_idepth,
                    std::vector<double>* idepths) {
  const SightLine line(view, sight.px);
  const Segment segment = visible_segment(view.level->pinhole, line, max_idepth);
  if (segment.length < kMinLengthPx) return false;
  thread_local std::vector<NearEdge> near;
  near.clear();
  walk_along(view.level->field, segment, &near);
  for (NearEdge& e : near) {
    e.at = view.level->field.edge_at(e.at);
    prefetch(&view.level->edges.pixels[size_t(e.at)]);
  }
  add_crossings(sight, view, line, segment, near, max_idepth, idepths);
  return true;
}

}  // namespace edgevo
