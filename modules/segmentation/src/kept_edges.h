// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edges of an earlier image, which of them the present one still shows at their place, and the chance of
// that for an edge of the scene.
#include <optional>
#include <vector>

#include "edgevo/edges/gradient.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Rounds a coordinate, which is not negative: as std::lround(), without its call. The sum is exact in
/// double.
inline int nearest_pixel(float v) { return int(double(v) + 0.5); }

/// An edge pixel of an earlier image, or the steepest pixel of a cell without one; position and unit normal
/// in pixels of the level.
struct KeptEdge {
  float x, y, nx, ny;
  /// Number of its cell; direction and region of the view.
  int cell, kind;
  /// Whether the present image shows it.
  bool seen = true;
};

/// The edges of one image, of every `step` edge pixels the first, and what is steepest in cells without one.
class KeptEdges {
 public:
  /// For images of this size; `cell_px`: side of a cell, pixels; of `step` pixels along an edge, which say
  /// the same, one is kept.
  KeptEdges(int width, int height, int cell_px, size_t step);
  /// Looks for all of them in an image. Cost: 0.1 ms for 4000.
  void look(const Gradient& gradient);
  /// Replaces them by those of another image, where `takes_part` of the cell is not 0. A cell without one
  /// gives its steepest pixel that is `shown` (ViewObserver::add_edges), if it stands out of noise: the
  /// threshold of edges follows the image, so that a textured part would leave the scene around it without a
  /// voice. Cost: 0.1 ms for 1241x376.
  void renew(const ImageEdges& edges, const Gradient& gradient, const Plane<uint8_t>& shown,
             const std::vector<uint8_t>& takes_part);
  /// All of them.
  const std::vector<KeptEdge>& all() const { return edges_; }
  /// By kind: the share of edges seen at their place, over those in blocks of the view that move
  /// (ViewMotion::moves). Edges along the motion stay where they are: it depends on direction and place.
  std::vector<double> chances(const std::vector<uint8_t>& moves) const;

  /// Cells across and down; number of a cell's block of the view.
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int block(int cell) const { return block_of_cell_[size_t(cell)]; }

 private:
  int kind(const EdgePixel& e) const;
  std::optional<EdgePixel> steepest_of(int cell, const Gradient& gradient, const Plane<uint8_t>& shown) const;

  int width_, height_, cell_px_, columns_, rows_;
  size_t step_;
  std::vector<int> block_of_cell_;
  std::vector<KeptEdge> edges_;
};

}  // namespace edgevo
