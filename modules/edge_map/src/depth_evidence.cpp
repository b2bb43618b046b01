// SPDX-License-Identifier: BSD-3-Clause
#include "depth_evidence.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/simd.h"

// How vectors are passed depends on the target; these functions are only called within this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edgevo {
namespace {

constexpr double kMinDepth = 0.05;  // of a point over its depth in the host: nearer is next to the camera
// From the projected point to the edge, across it: in the first two passes the depth is not yet exact.
constexpr double kReachPx[] = {3.0, 2.0, 1.25};
constexpr int kLooks = 3;
constexpr double kAlongPx = 2.5;  // from the point to the nearest edge pixel, any direction, plus the reach
constexpr float kSidePx = 2;      // off the edge: outside the blur of the step itself
// Motion across the edge from infinity to the depth of the point, below which a view does not constrain
// depth.
constexpr double kMinMotionPx = 3;

using FourMasks = int64_t __attribute__((vector_size(32)));  // -1 where something holds, else 0
using FourPixels = int32_t __attribute__((vector_size(16)));
using FourFloats = float __attribute__((vector_size(16)));

// Four views of a point, and the nearest edge in each.
struct alignas(32) LookGroup {
  FourViews x, y, depth;       // of the point in the view, depth over that in the host
  FourViews e_x, e_y, nx, ny;  // position and normal of the edge
  FourMasks in_view, is_new;   // -1: the view is used; the point lies at another pixel than in the last pass
  FourMasks fits;              // -1: an edge of like direction with a like side
  FourMasks dark_differs, bright_differs;
  FourPixels column, row;  // of the point
};

// What the views say together.
struct EquationSums {
  double A = 0, b = 0, cost = 0;  // of A (rho - idepth) = b
  FourMasks views{}, informative{}, dark_differs{}, bright_differs{};
};

// Into both versions of look_at_views().
#define EDGEVO_INLINE inline __attribute__((always_inline))

EDGEVO_INLINE FourPixels narrow(const FourMasks& m) {
  using Halves = int32_t __attribute__((vector_size(32)));
  const Halves h = Halves(m);
  return __builtin_shufflevector(h, h, 0, 2, 4, 6);
}
EDGEVO_INLINE FourMasks widen(const FourPixels& m) { return __builtin_convertvector(m, FourMasks); }
EDGEVO_INLINE int count(const FourMasks& m) { return -int(m[0] + m[1] + m[2] + m[3]); }
EDGEVO_INLINE FourViews magnitude(const FourViews& v) {
  return FourViews(FourMasks(v) & int64_t(0x7FFFFFFFFFFFFFFF));
}
EDGEVO_INLINE FourViews only(const FourMasks& where, const FourViews& v) {
  return FourViews(FourMasks(v) & where);
}

// The area of a view in which points are looked at.
struct Bounds {
  double first, last_x, last_y;
};

// Projects the point into four views, of which at most `room` are used. Returns how many are.
EDGEVO_INLINE int project(const SightGroup& sight, const ViewGroup& view, double idepth, const Bounds& bounds,
                          int room, LookGroup* look) {
  look->depth = sight.h[2] + idepth * view.e[2];
  look->x = (sight.h[0] + idepth * view.e[0]) / look->depth;
  look->y = (sight.h[1] + idepth * view.e[1]) / look->depth;
  FourMasks in_view = (look->depth > kMinDepth) & (look->depth < kMaxDepthRatio) & (look->x >= bounds.first) &
                      (look->y >= bounds.first) & (look->x <= bounds.last_x) & (look->y <= bounds.last_y);
  int used = count(in_view);
  for (size_t v = kViewsAtOnce; used > room;)
    if (in_view[--v]) in_view[v] = 0, --used;
  look->in_view = in_view;
  const FourFloats half = FourFloats{} + 0.5f;
  const FourPixels column =
      __builtin_convertvector(__builtin_convertvector(only(in_view, look->x), FourFloats) + half, FourPixels);
  const FourPixels row =
      __builtin_convertvector(__builtin_convertvector(only(in_view, look->y), FourFloats) + half, FourPixels);
  look->is_new = widen((column != look->column) | (row != look->row)) & in_view;
  look->column = column, look->row = row;
  return used;
}

// A point to look up in one view.
struct LookUp {
  const ViewGeometry* view;
  LookGroup* look;
  const SightGroup* lines;
  size_t lane;
  int at;  // first the pixel of the nearest edge, then its edge pixel; -1: none
};

// Compares what does not depend on the distance with the edge that was found.
EDGEVO_INLINE void compare(const EdgeSight& sight, const LookUp& up) {
  const size_t v = up.lane;
  up.look->fits[v] = 0;
  if (up.at < 0) return;
  const EdgePixel& e = up.view->level->edges.pixels[size_t(up.at)];
  if (!is_like_direction(up.lines->normal[0][v], up.lines->normal[1][v], e)) return;
  const SideChange change = compare_sides(sight.sides, *up.view, size_t(up.at));
  up.look->e_x[v] = double(e.x), up.look->e_y[v] = double(e.y);
  up.look->nx[v] = double(e.nx), up.look->ny[v] = double(e.ny);
  up.look->fits[v] = -int64_t(!(change.dark && change.bright));
  up.look->dark_differs[v] = -int64_t(change.dark), up.look->bright_differs[v] = -int64_t(change.bright);
}

// What the next pixel of the edge will read, next to what this one does.
EDGEVO_INLINE void prefetch_next(const EdgeSight& sight, const PyramidLevel& level, int pixel) {
  const int next = pixel + int(sight.to_next.y()) * level.edges.width + int(sight.to_next.x());
  if (next >= 0 && next < level.edges.width * level.edges.height) level.field.prefetch_edge(next);
}
EDGEVO_INLINE void prefetch_edges(const EdgeSight& sight, const std::vector<EdgePixel>& edges, int at) {
  prefetch(&edges[size_t(at)]);
  prefetch(&edges[size_t(std::max(0, at - sight.step))]);
  prefetch(&edges[std::min(edges.size() - 1, size_t(at + sight.step))]);
}

// Finds the edge nearest to each point. What is read lies nowhere near in memory, and each read depends on
// the one before: in turn for all views, they wait for memory together.
EDGEVO_INLINE void look_up(const EdgeSight& sight, LookUp* begin, LookUp* end) {
  for (LookUp* up = begin; up != end; ++up) {
    const float x = float(up->look->column[up->lane]), y = float(up->look->row[up->lane]);
    const PyramidLevel& level = *up->view->level;
    up->at = level.field.nearest_pixel(x, y);
    level.field.prefetch_pixel(x + sight.to_next.x(), y + sight.to_next.y());
    if (up->at < 0) continue;
    level.field.prefetch_edge(up->at);
    prefetch_next(sight, level, up->at);
  }
  for (LookUp* up = begin; up != end; ++up) {
    if (up->at < 0) continue;
    up->at = up->view->level->field.edge_at(up->at);
    prefetch_edges(sight, up->view->level->edges.pixels, up->at);
    prefetch(&(*up->view->sides)[size_t(up->at)]);
  }
  for (const LookUp* up = begin; up != end; ++up) compare(sight, *up);
}

// One equation for the inverse depth from each of four views.
EDGEVO_INLINE void add_equations(const LookGroup& look, const ViewGroup& view, double idepth, double reach,
                                 EquationSums* sums) {
  const FourViews off_x = look.e_x - look.x, off_y = look.e_y - look.y;
  const FourViews residual = look.nx * off_x + look.ny * off_y;
  const double farthest = (kAlongPx + reach) * (kAlongPx + reach);
  const FourMasks found =
      look.in_view & look.fits & (magnitude(residual) <= reach) & (off_x * off_x + off_y * off_y <= farthest);
  const FourViews slope = only(found, look.nx * ((view.e[0] - look.x * view.e[2]) / look.depth) +
                                          look.ny * ((view.e[1] - look.y * view.e[2]) / look.depth));
  const FourViews share = residual / kReachPx[kLooks - 1], one = FourViews{} + 1.0;
  const FourViews squared = share * share;
  const FourViews misfit = only(look.in_view, found ? (squared < one ? squared : one) : one);
  // Zeros change no sum: these are those over the views that count, in their order.
  const FourViews A = slope * slope, b = slope * residual;
  for (size_t v = 0; v < kViewsAtOnce; ++v) {
    sums->A += A[v], sums->b += b[v], sums->cost += misfit[v];
  }
  sums->views += found;
  sums->informative += found & (magnitude(slope) * idepth >= kMinMotionPx);
  sums->dark_differs += found & look.dark_differs;
  sums->bright_differs += found & look.bright_differs;
}

// weigh() for one inverse depth. Points that stay at their pixel are not looked up again.
EDGEVO_WIDE_CLONES int look_at_views(const EdgeSight& sight, const ViewSet& set, double idepth, double reach,
                                     int most, LookGroup* looks, LookUp* ups, EquationSums* sums) {
  const Pinhole& size = set.views.front().level->pinhole;
  const Bounds bounds{kEdgeBorderPx, size.width - 1 - kEdgeBorderPx, size.height - 1 - kEdgeBorderPx};
  int in_view = 0;
  size_t groups = 0;
  for (; groups < set.groups.size() && in_view < most; ++groups)
    in_view +=
        project(sight.lines[groups], set.groups[groups], idepth, bounds, most - in_view, &looks[groups]);
  LookUp* end = ups;
  for (size_t g = 0; g < groups; ++g)
    for (size_t v = 0; v < kViewsAtOnce; ++v)
      if (looks[g].is_new[v]) {
        const ViewGeometry& view = set.views[g * kViewsAtOnce + v];
        view.level->field.prefetch_pixel(float(looks[g].column[v]), float(looks[g].row[v]));
        *end++ = {&view, &looks[g], &sight.lines[g], v, -1};
      }
  look_up(sight, ups, end);
  for (size_t g = 0; g < groups; ++g) add_equations(looks[g], set.groups[g], idepth, reach, sums);
  return in_view;
}
#undef EDGEVO_INLINE

// Enough to look everything up: no point lies at pixel -1.
void forget(std::vector<LookGroup>* looks) {
  for (LookGroup& look : *looks) {
    look.column = FourPixels{} - 1;
    look.fits = FourMasks{};
  }
}

// Probability that a view shows an edge that is there: others are occluded, blurred, or not found. And that
// it shows one by chance where there is none.
constexpr double kShown = 0.5, kByChance = 0.125;

// What the views show if the edge has the depth of `h`, up to a constant, of at most `most` views: those that
// contain a point at this depth alone compare nothing. Those that do not contain it, but show the edge at the
// other, support that: limited to what contains all, markings are fewer and less right.
double log_likelihood(const Hypothesis& h, int most) {
  const double shown = h.in_view - h.cost, not_shown = h.cost;
  const double share = h.in_view > most ? double(most) / h.in_view : 1;
  return share *
         (shown * std::log(kShown / kByChance) + not_shown * std::log((1 - kShown) / (1 - kByChance)));
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

Hypothesis weigh(const EdgeSight& sight, const ViewSet& set, double idepth, Guess guess, double max_idepth,
                 const EdgeMapParams& params) {
  thread_local std::vector<LookGroup> looks;
  thread_local std::vector<LookUp> ups;
  looks.resize(set.groups.size()), ups.resize(kViewsAtOnce * set.groups.size());
  forget(&looks);
  Hypothesis h;
  for (int pass = int(guess); pass < kLooks; ++pass) {
    EquationSums sums;
    h.idepth = idepth;
    if (!set.views.empty())
      h.in_view =
          look_at_views(sight, set, idepth, kReachPx[pass], params.views, looks.data(), ups.data(), &sums);
    h.views = count(sums.views);
    h.informative = count(sums.informative);
    h.dark_differs = count(sums.dark_differs), h.bright_differs = count(sums.bright_differs);
    h.cost = sums.cost;
    h.information = sums.A / (kEdgeSigmaPx * kEdgeSigmaPx);
    if (h.views < params.min_views) return h;
    if (pass < kLooks - 1 && sums.A > 0) idepth = std::clamp(idepth + sums.b / sums.A, 0.0, max_idepth);
  }
  return h;
}

double log_odds_of_edge(double shown, double not_shown) {
  // Copies of an edge, displaced by 6 or 9 pixels, meet one in 3 to 6 % of the images: street, motorway,
  // corridor, office and lakeshore.
  constexpr double kDisplaced = 0.05;
  static const double per_shown = std::log(kShown / kDisplaced),
                      per_not_shown = std::log((1 - kShown) / (1 - kDisplaced));
  return shown * per_shown + not_shown * per_not_shown;
}

double log_likelihood_ratio(const EdgeSight& sight, const ViewSet& set, double idepth, double own,
                            double max_idepth, const EdgeMapParams& params) {
  const auto look = [&](double at) { return weigh(sight, set, at, Guess::kExact, max_idepth, params); };
  const Hypothesis here = look(idepth);
  const auto likelihood = [&](double at) { return std::exp(log_likelihood(look(at), here.in_view)); };
  const double elsewhere = 0.5 * (likelihood(0.5 * idepth) + likelihood(2 * idepth));
  return log_likelihood(here, here.in_view) - std::log(std::max(elsewhere, own > 0 ? likelihood(own) : 0));
}

}  // namespace edgevo
