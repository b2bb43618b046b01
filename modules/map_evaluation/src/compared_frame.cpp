// SPDX-License-Identifier: BSD-3-Clause
#include "compared_frame.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

// The drawn pixels of a view by the pixel that they lie at, to find those next to an edge.
class DrawnGrid {
 public:
  DrawnGrid(const std::vector<DrawnPixel>& drawn, const Pinhole& p)
      : drawn_(drawn), width_(p.width), height_(p.height) {
    first_.assign(size_t(width_) * size_t(height_), -1);
    next_.resize(drawn.size());
    for (size_t i = 0; i < drawn.size(); ++i) {
      int& first = first_[size_t(std::lround(drawn[i].px.y()) * width_ + std::lround(drawn[i].px.x()))];
      next_[i] = first, first = int(i);
    }
  }

  // Whether one within `reach` pixels is what `is_it` looks for.
  template <class F>
  bool any_near(const Eigen::Vector2d& px, double reach, const F& is_it) const {
    const int r = int(std::ceil(reach)), u = int(std::lround(px.x())), v = int(std::lround(px.y()));
    for (int y = std::max(0, v - r); y <= std::min(height_ - 1, v + r); ++y)
      for (int x = std::max(0, u - r); x <= std::min(width_ - 1, u + r); ++x)
        for (int i = first_[size_t(y * width_ + x)]; i >= 0; i = next_[size_t(i)])
          if ((drawn_[size_t(i)].px - px).norm() <= reach && is_it(size_t(i))) return true;
    return false;
  }

 private:
  const std::vector<DrawnPixel>& drawn_;
  int width_, height_;
  std::vector<int> first_, next_;
};

}  // namespace

ComparedFrame::ComparedFrame(const SceneRenderer& scene, PyramidBuilder* builder, const PlacedLines& lines,
                             int index, const MapEvaluationOptions& o)
    : view(scene, builder, index, index >= o.every ? index - o.every : std::min(o.every, scene.size() - 1)),
      drawn(draw_lines(lines, view.pinhole(), view.T_scene_cam())) {
  for (const DrawnPixel& d : drawn) {
    is_hidden.push_back(view.is_hidden(d.px, d.depth, o.within_px, o.depth_share));
    is_right.push_back(view.has_edge(d.px, d.depth, o.within_px, o.depth_share));
    place.push_back(view.place_of(d.px, d.normal, d.depth));
  }
  constexpr double kAlike = 0.94;  // cosine of the angle between an edge and a line along it: 20 degrees
  const DrawnGrid grid(drawn, view.pinhole());
  for (const TrueEdgePixel& e : view.edges()) {
    const auto explains = [&](size_t i) {
      return std::abs(drawn[i].depth - e.depth) <= o.depth_share * e.depth;
    };
    const auto misplaces = [&](size_t i) {
      return !is_right[i] && std::abs(drawn[i].normal.dot(e.normal)) >= kAlike;
    };
    is_found.push_back(grid.any_near(e.px, o.within_px, explains));
    is_misplaced.push_back(!is_found.back() && grid.any_near(e.px, o.within_px, misplaces));
  }
}

}  // namespace edgevo
