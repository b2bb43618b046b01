#include "edgevo/association/look_ahead.h"

#include <algorithm>

#include "edgevo/association/normal_refinement.h"
#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

// Rows of the square of `radius` pixels around (x, y), and the row that interpolation needs below.
template <class T>
void prefetch_square(const Plane<T>& image, int x, int y, int radius) {
  const int left = std::max(0, x - radius), last = std::min(image.height() - 1, y + radius + 1);
  for (int row = std::max(0, y - radius); row <= last; ++row) prefetch(&image.at(left, row));
}

}  // namespace

void LookAhead::add(const FramePyramid& target, const Eigen::Vector2d& px) {
  if (count_ == int(places_.size())) run();
  Place& place = places_[count_++];
  place = {&target.finest(), px.cast<float>(), -1};
  place.level->field.prefetch_pixel(place.px.x(), place.px.y());
}

int LookAhead::run() {
  int near_edges = 0;
  for (int i = 0; i < count_; ++i) {
    Place& p = places_[i];
    p.pixel = p.level->field.nearest_pixel(p.px.x(), p.px.y());
    if (p.pixel >= 0) p.level->field.prefetch_edge(p.pixel);
  }
  for (int i = 0; i < count_; ++i) {
    const Place& p = places_[i];
    if (p.pixel < 0) continue;
    ++near_edges;
    const int width = p.level->pinhole.width, x = p.pixel % width, y = p.pixel / width;
    prefetch(&p.level->edges.pixels[p.level->field.edge_at(p.pixel)]);
    if (params_.photometric) prefetch_square(p.level->gradient_magnitude, x, y, params_.patch_side / 2);
    if (params_.refine) prefetch_square(p.level->gray, x, y, kRefinementRadius);
  }
  count_ = 0;
  return near_edges;
}

}  // namespace edgevo
