// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edges of an earlier image, which of them the present one still shows at their place, and the chance of
// that for an edge of the scene.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edgevo/edges/gradient.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Share of the edges of what keeps its place that are found there again: outlines vanish at times.
constexpr double kFoundAgain = 0.7;

/// Rounds a coordinate, which is not negative: as std::lround(), without its call. The sum is exact in
/// double.
inline int nearest_pixel(float v) { return int(double(v) + 0.5); }

/// Where the rows of a rolling shutter were moved from when an image was rectified: what is fixed to the
/// camera keeps its place before that, not after. Pixels of the level.
class RowShifts {
 public:
  /// Distance of the places whose shift is known, pixels.
  static constexpr int kStepPx = 8;
  /// None, or those at every eighth pixel of images of this width, from `columns * rows` of them.
  RowShifts() = default;
  RowShifts(int width, std::vector<Eigen::Vector2f> shifts)
      : columns_((width + kStepPx - 1) / kStepPx), shifts_(std::move(shifts)) {}
  /// Shift of a pixel of the image.
  Eigen::Vector2f at(float x, float y) const {
    if (shifts_.empty()) return Eigen::Vector2f::Zero();
    return shifts_[size_t(int(y) / kStepPx * columns_ + int(x) / kStepPx)];
  }

 private:
  int columns_ = 0;
  std::vector<Eigen::Vector2f> shifts_;
};

/// An edge pixel of an earlier image, or the steepest pixel of a cell without one; position in pixels of
/// the level, before rows were moved, and unit normal.
struct KeptEdge {
  float x, y, nx, ny;
  /// Number of its cell; direction and region of the view.
  int cell, kind;
  /// Whether the present image shows it.
  bool seen = true;
  /// Or within two pixels across it: what begins to move goes there first, what is hidden is gone.
  bool slid = false;
};

/// The edges of one image, of every `step` edge pixels the first, and what is steepest in cells without one.
class KeptEdges {
 public:
  /// For images of this size; `cell_px`: side of a cell, pixels; of `step` pixels along an edge, which say
  /// the same, one is kept.
  KeptEdges(int width, int height, int cell_px, size_t step);
  /// Looks for all of them in an image. Cost: 0.1 ms for 4000.
  void look(const Gradient& gradient, const RowShifts& rows, bool looks_around = false);
  /// Replaces them by those of another image, where `takes_part` of the cell is not 0. A cell without one
  /// gives its steepest pixel that is `shown` (ViewObserver::add_edges), if it stands out of noise: the
  /// threshold of edges follows the image, so that a textured part would leave the scene around it without a
  /// voice. Cost: 0.1 ms for 1241x376.
  void renew(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown,
             const RowShifts& rows, const std::vector<uint8_t>& takes_part);
  /// All of them.
  const std::vector<KeptEdge>& all() const { return edges_; }
  /// By kind: the share of edges seen at their place, over those in blocks of the view that move
  /// (ViewMotion::moves). Edges along the motion stay where they are: it depends on direction and place.
  std::vector<double> chances(const std::vector<uint8_t>& moves, const std::vector<uint8_t>& votes) const;

  /// Cells across and down; number of a cell's block of the view.
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int block(int cell) const { return block_of_cell_[size_t(cell)]; }

 private:
  int cell_at(float x, float y) const {
    return nearest_pixel(y) / cell_px_ * columns_ + nearest_pixel(x) / cell_px_;
  }
  // Whether a place and its neighbours lie inside the image.
  bool is_inside(float x, float y) const {
    return x >= 1 && y >= 1 && x < float(width_ - 2) && y < float(height_ - 2);
  }
  int kind(const EdgePixel& e) const;
  void keep(const EdgePixel& e, const RowShifts& rows, const std::vector<uint8_t>& takes_part);
  std::optional<EdgePixel> steepest_of(int cell, const Gradient& gradient, const Plane<uint8_t>& shown) const;

  int width_, height_, cell_px_, columns_, rows_;
  size_t step_;
  std::vector<int> block_of_cell_;
  std::vector<KeptEdge> edges_;
};

}  // namespace edgevo
