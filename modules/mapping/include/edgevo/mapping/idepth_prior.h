// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the window knows about depth in an image: smallest and largest inverse depth near a pixel. New points
// are searched around these: neighbours mostly lie on the same surface, and a short search has fewer wrong
// matches than one around the median of the image.
#include <algorithm>
#include <limits>
#include <vector>

#include "edgevo/core/order_statistics.h"
#include "edgevo/mapping/depth_filter.h"

namespace edgevo {

/// Search range around the inverse depths known nearby, `low` to `high`.
inline IdepthRange range_around(double low, double high) {
  constexpr double kLowFactor = 0.4, kHighFactor = 2.5;
  return {kLowFactor * low, kHighFactor * high};
}

/// Depths that a map has seen so far.
struct SeenIdepths {
  /// Median inverse depth of the newest image that knew any.
  double median = 1;
  /// Largest inverse depth of any image, its 95 % quantile; 0: none yet. A camera that comes back from an
  /// open view meets what is as near again.
  double nearest = 0;
};

/// Depths known in one image, by cell.
class IdepthPrior {
 public:
  /// `before`: depths of earlier images; the median is used while nothing is known in this one.
  IdepthPrior(const CellGrid& grid, const DepthFilterParams& params, const SeenIdepths& before)
      : use_neighbours_(params.use_neighbour_depths),
        grid_(grid),
        low_(grid_.size(), kNone),
        high_(grid_.size(), 0),
        occupied_(grid_.size(), false),
        least_(kFarLow * before.median),
        seen_(before) {}

  /// Adds a point of known depth: `px` inside the image, `idepth` > 0 in its camera. A point beyond the range
  /// of any search occupies its cell, but says nothing of the depths around it: adjustment drives points to
  /// infinity where the camera only turns, and a map that takes its unit from those has lost it.
  void add(const Eigen::Vector2d& px, double idepth) {
    const int c = grid_.index(px.x(), px.y());
    occupied_[c] = true;
    if (idepth < least_) return;
    low_[c] = std::min(low_[c], idepth);
    high_[c] = std::max(high_[c], idepth);
    all_.push_back(idepth);
  }

  /// Whether a known depth lies in the cell.
  bool occupied(int cell) const { return occupied_[cell]; }
  /// The cells.
  const CellGrid& grid() const { return grid_; }

  /// Search range at `px`: around the depths in the 5x5 cells about it, else around the median of the image,
  /// and as near as any depth of the map.
  IdepthRange range(const Eigen::Vector2d& px) {
    const int column = grid_.column(px.x()), row = grid_.row(px.y());
    double low = kNone, high = 0;
    for (int r = std::max(0, row - 2); r <= std::min(grid_.rows() - 1, row + 2); ++r)
      for (int c = std::max(0, column - 2); c <= std::min(grid_.columns() - 1, column + 2); ++c) {
        low = std::min(low, low_[r * grid_.columns() + c]);
        high = std::max(high, high_[r * grid_.columns() + c]);
      }
    if (high > 0 && use_neighbours_) return range_around(low, high);
    return {kFarLow * median(), std::max(kFarHigh * median(), seen().nearest), median()};
  }

  /// Median inverse depth of the image, or of the earlier one if nothing is known.
  double median() { return seen().median; }

  /// Depths of the map up to this image.
  const SeenIdepths& seen() {
    // Share of the depths of an image: a few wrong ones are the nearest. Set by nine drives over open land,
    // confirmed by twenty others.
    constexpr double kNearShare = 0.95;
    if (!all_.empty()) {
      seen_.nearest = std::max(seen_.nearest, quantile(all_, kNearShare));
      seen_.median = edgevo::median(std::move(all_));
      all_.clear();
    }
    return seen_;
  }

 private:
  // Search range without known depths nearby, as factors on the median inverse depth.
  static constexpr double kFarLow = 0.02, kFarHigh = 8.0;
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  bool use_neighbours_;
  CellGrid grid_;
  std::vector<double> low_, high_, all_;
  std::vector<bool> occupied_;
  double least_;
  SeenIdepths seen_;
};

}  // namespace edgevo
