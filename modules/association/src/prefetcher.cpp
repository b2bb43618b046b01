// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/prefetcher.h"

#include <algorithm>

#include "edgevo/association/normal_refinement.h"
#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

// Prefetches the rows within `radius` pixels around (x, y), and the row below that interpolation needs.
template <class T>
void prefetch_square(const ImageView<T>& image, int x, int y, int radius) {
  const int left = std::max(0, x - radius), last = std::min(image.height - 1, y + radius + 1);
  for (int row = std::max(0, y - radius); row <= last; ++row) prefetch(&image.at(left, row));
}

}  // namespace

void Prefetcher::add(const FramePyramid& target, const Eigen::Vector2d& px) {
  if (count_ == int(slots_.size())) run();
  Slot& slot = slots_[count_++];
  slot = {&target.finest(), px.cast<float>(), -1};
  slot.level->field.prefetch_pixel(slot.px.x(), slot.px.y());
}

int Prefetcher::run() {
  int near_edges = 0;
  for (int i = 0; i < count_; ++i) {
    Slot& p = slots_[i];
    p.pixel = p.level->field.nearest_pixel(p.px.x(), p.px.y());
    if (p.pixel >= 0) p.level->field.prefetch_edge(p.pixel);
  }
  for (int i = 0; i < count_; ++i) {
    const Slot& p = slots_[i];
    if (p.pixel < 0) continue;
    ++near_edges;
    const int width = p.level->pinhole.width, x = p.pixel % width, y = p.pixel / width;
    prefetch(&p.level->edges.pixels[p.level->field.edge_at(p.pixel)]);
    if (params_.photometric)
      prefetch_square(p.level->gradient_magnitude.view(), x, y, params_.patch_side / 2);
    if (params_.refine)
      p.level->with_gray([&](const auto& gray) { prefetch_square(gray, x, y, kRefinementRadius); });
  }
  count_ = 0;
  return near_edges;
}

}  // namespace edgevo
