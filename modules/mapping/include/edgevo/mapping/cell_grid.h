// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cells of an image, over which points are spread.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/rectification.h"

namespace edgevo {

/// Intervals of the pixels along one side of an image.
struct CellAxis {
  /// Interval of each pixel.
  std::vector<int> of;
  /// Pixel at which each interval begins, and the one after the last.
  std::vector<double> begin;

  /// Intervals of `cell_px` pixels; the last may be cut off.
  CellAxis(int pixels, int cell_px);
  /// As many intervals, of equal length in `raw`: a position in the raw image for each of `pixels` + 1
  /// borders of pixels. Where `raw` does not ascend, they are those of equal length in pixels.
  CellAxis(int pixels, int cell_px, const std::vector<double>& raw);

  /// Number of intervals.
  int size() const { return int(begin.size()) - 1; }
  /// Middle of an interval.
  double middle(int interval) const { return 0.5 * (begin[interval] + begin[interval + 1]); }
};

/// Cells over an image, in row-major order.
///
/// They are squares of `cell_px` pixels; in the rectified images of a wide lens there are as many, but of
/// equal width and height in the raw image. Towards its border a pinhole enlarges what such a lens shows, a
/// fisheye to 6.6 times the area 60 degrees off the axis. Squares would spend most points there, on pixels
/// that repeat each other, and leave few for the middle, which may be all that shows how far the camera moves
/// (lab 2026-11-26_lenses).
class CellGrid {
 public:
  /// Squares over an image of width x height pixels.
  CellGrid(int width, int height, int cell_px) : x_(width, cell_px), y_(height, cell_px) {}
  /// Over the rectified image. Squares for a lens without or with plumb-bob distortion. Cost for another: a
  /// projection for each row and column.
  CellGrid(const Rectification& rectification, int cell_px);

  /// Cell of a pixel of the image (not checked).
  int index(double x, double y) const { return row(y) * columns() + column(x); }
  /// Column of cells at x (not checked).
  int column(double x) const { return x_.of[size_t(x)]; }
  /// Row of cells at y (not checked).
  int row(double y) const { return y_.of[size_t(y)]; }
  /// Middle of a cell, pixels.
  Eigen::Vector2d centre(int cell) const {
    return {x_.middle(cell % columns()), y_.middle(cell / columns())};
  }
  /// Number of cells along x.
  int columns() const { return x_.size(); }
  /// Number of cells along y.
  int rows() const { return y_.size(); }
  /// Number of cells.
  int size() const { return columns() * rows(); }

 private:
  CellAxis x_, y_;
};

}  // namespace edgevo
