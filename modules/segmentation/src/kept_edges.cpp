// SPDX-License-Identifier: BSD-3-Clause
#include "kept_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "view_motion.h"

namespace edgevo {
namespace {

constexpr float kFaintest = 8;           // Sobel units: noise alone makes half as much
constexpr float kClear = 3 * kFaintest;  // of a cell's steepest pixel: found again under noise
constexpr float kSameDirection = 0.9f;   // cosine
// Directions of edges, regions of the view by row and column, whose chances are measured.
constexpr int kDirections = 12, kRegions = 3;
constexpr double kPriorEdges = 20;  // of all places and directions, that a chance is measured with

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Interpolated; the place and its neighbours lie inside the image.
template <class T>
float value_at(const Plane<T>& plane, float x, float y) {
  const int left = int(x), top = int(y);
  const float across = x - float(left), down = y - float(top);
  const T *upper = plane.row(top) + left, *lower = plane.row(top + 1) + left;
  const float above = float(upper[0]) + across * (float(upper[1]) - float(upper[0]));
  const float below = float(lower[0]) + across * (float(lower[1]) - float(lower[0]));
  return above + down * (below - above);
}

// Whether an edge of this normal, either sign, lies here: the gradient has its direction and falls on both
// sides within a pixel. In the gradient, not among the edges: their threshold follows the image, and faint
// edges of a part, though they are there, fall below it whenever the scene has much contrast.
bool shows_edge(const Gradient& gradient, float x, float y, float nx, float ny) {
  const float dx = value_at(gradient.dx, x, y), dy = value_at(gradient.dy, x, y);
  const float along = std::abs(dx * nx + dy * ny);
  if (along < kFaintest * kGradientSteps ||
      along * along < kSameDirection * kSameDirection * (dx * dx + dy * dy))
    return false;
  const float here = value_at(gradient.magnitude, x, y);
  return here >= value_at(gradient.magnitude, x - nx, y - ny) &&
         here > value_at(gradient.magnitude, x + nx, y + ny);
}

}  // namespace

KeptEdges::KeptEdges(int width, int height, int cell_px, size_t step)
    : width_(width),
      height_(height),
      cell_px_(cell_px),
      columns_((width + cell_px - 1) / cell_px),
      rows_((height + cell_px - 1) / cell_px),
      step_(step) {
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      block_of_cell_.push_back(y * ViewMotion::kRows / rows_ * ViewMotion::kColumns +
                               x * ViewMotion::kColumns / columns_);
}

int KeptEdges::kind(const EdgePixel& e) const {
  const double angle = std::atan2(e.ny, e.nx) * (kDirections / M_PI) + 2.5 * kDirections;
  const int column = int(e.x) * kRegions / width_, row = int(e.y) * kRegions / height_;
  return (row * kRegions + column) * kDirections + int(angle) % kDirections;
}

void KeptEdges::look(const Gradient& gradient, const RowShifts& rows, bool looks_around) {
  for (KeptEdge& e : edges_) {
    const Eigen::Vector2f px = Eigen::Vector2f(e.x, e.y) - rows.at(e.x, e.y);
    e.seen = is_inside(px.x(), px.y()) && shows_edge(gradient, px.x(), px.y(), e.nx, e.ny);
    e.slid = false;
    for (const float side : {-2.f, -1.f, 1.f, 2.f}) {
      if (!looks_around || e.seen || e.slid) break;
      const float x = px.x() + side * e.nx, y = px.y() + side * e.ny;
      e.slid = is_inside(x, y) && shows_edge(gradient, x, y, e.nx, e.ny);
    }
  }
}

void KeptEdges::keep(const EdgePixel& e, const RowShifts& rows, const std::vector<uint8_t>& takes_part) {
  const Eigen::Vector2f px = e.position() + rows.at(e.x, e.y);
  if (!is_inside(px.x(), px.y())) return;
  const int cell = cell_at(px.x(), px.y());
  if (takes_part[size_t(cell)]) edges_.push_back({px.x(), px.y(), e.nx, e.ny, cell, kind(e)});
}

// The steepest pixel of a cell; its gradient falls on both sides.
std::optional<EdgePixel> KeptEdges::steepest_of(int cell, const Gradient& gradient,
                                                const Plane<uint8_t>& shown) const {
  const int left = cell % columns_ * cell_px_, top = cell / columns_ * cell_px_;
  float most = kClear;
  int at_x = -1, at_y = -1;
  for (int y = std::max(top, 2); y < std::min(top + cell_px_, height_ - 2); ++y) {
    const float* row = gradient.magnitude.row(y);
    for (int x = std::max(left, 2); x < std::min(left + cell_px_, width_ - 2); ++x)
      if (row[x] > most && (shown.empty() || shown.at(x, y))) most = row[x], at_x = x, at_y = y;
  }
  if (at_x < 0) return std::nullopt;
  EdgePixel e;
  e.x = float(at_x), e.y = float(at_y);
  const float dx = gradient.dx.at(at_x, at_y), dy = gradient.dy.at(at_x, at_y), length = std::hypot(dx, dy);
  e.nx = dx / length, e.ny = dy / length;
  if (!shows_edge(gradient, e.x, e.y, e.nx, e.ny)) return std::nullopt;
  return e;
}

void KeptEdges::renew(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown,
                      const RowShifts& rows, const std::vector<uint8_t>& takes_part) {
  edges_.clear();
  std::vector<uint8_t> has_one(takes_part.size());
  for (size_t i = 0; i < edges.pixels.size(); i += step_) {
    const EdgePixel& e = edges.pixels[i];
    has_one[size_t(cell_at(e.x, e.y))] = 1;
    keep(e, rows, takes_part);
  }
  for (size_t cell = 0; cell < has_one.size(); ++cell)
    if (takes_part[cell] && !has_one[cell])
      if (const auto e = steepest_of(int(cell), gradient, shown)) keep(*e, rows, takes_part);
}

std::vector<double> KeptEdges::chances(const std::vector<uint8_t>& moves,
                                       const std::vector<uint8_t>& votes) const {
  constexpr int kPlaces = kRegions * kRegions;
  std::vector<double> all(kPlaces * kDirections), seen(kPlaces * kDirections);
  for (const KeptEdge& e : edges_) {
    if (!moves[size_t(block(e.cell))] || !votes[size_t(e.cell)]) continue;
    ++all[size_t(e.kind)];
    seen[size_t(e.kind)] += e.seen;
  }
  // Few edges of a direction at a place borrow from other places, few of a direction from all.
  const double every = (kPriorEdges + sum(seen)) / (kPriorEdges + sum(all));
  std::vector<double> chances(all.size());
  for (int d = 0; d < kDirections; ++d) {
    double all_here = 0, seen_here = 0;
    for (int p = 0; p < kPlaces; ++p)
      all_here += all[size_t(p * kDirections + d)], seen_here += seen[size_t(p * kDirections + d)];
    const double along = (kPriorEdges * every + seen_here) / (kPriorEdges + all_here);
    for (int p = 0; p < kPlaces; ++p) {
      const size_t i = size_t(p * kDirections + d);
      chances[i] = (kPriorEdges * along + seen[i]) / (kPriorEdges + all[i]);
    }
  }
  return chances;
}

}  // namespace edgevo
