// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Undistortion: an image as the pinhole camera of a Rectification would show it, each pixel sampled at its
// position in the raw image.
#include <cstdint>
#include <utility>
#include <vector>

#include "edgevo/core/rectification.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Bilinear undistortion with positions rounded to 1/128 px; beyond the border of the raw image its border
/// pixels are repeated. Raw images have at least 2x2 pixels. Faster than OpenCV's remap, which rounds
/// positions to 1/32 px. Pixels have 8 or 16 bits.
class Undistortion {
 public:
  /// For raw images of width x height.
  Undistortion(const RectificationMaps& maps, int width, int height);
  /// Undistorts an image of that size; `out` has the size of the maps.
  template <class T>
  void apply(const ImageView<T>& image, Plane<T>* out) const;

 private:
  int width_, height_;                 // of the maps
  std::vector<int32_t> corner_;        // per pixel: upper left of the four around its position, x + y * width
  std::vector<uint8_t> right_, down_;  // from there, in 1/128 px, 0..128
};

/// Smooth shift of an image of width x height, given at nodes kCell pixels apart that extend beyond its
/// border.
class ShiftGrid {
 public:
  /// Distance of nodes, pixels: over so few the shift of a smooth motion is almost linear.
  static constexpr int kCell = 16;
  ShiftGrid(int width, int height)
      : columns_((width - 1) / kCell + 2),
        rows_((height - 1) / kCell + 2),
        x_(size_t(columns_) * rows_),
        y_(x_.size()) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  void set(int column, int row, float x, float y) { x_[index(column, row)] = x, y_[index(column, row)] = y; }
  const float* x(int row) const { return &x_[index(0, row)]; }
  const float* y(int row) const { return &y_[index(0, row)]; }

 private:
  size_t index(int column, int row) const { return size_t(row) * columns_ + column; }
  int columns_, rows_;
  std::vector<float> x_, y_;
};

/// Undistortion with an additional shift in the raw image that differs per frame, for a rolling shutter.
/// Slower, since positions are computed for each image.
class ShiftedUndistortion {
 public:
  explicit ShiftedUndistortion(RectificationMaps maps) : maps_(std::move(maps)) {}
  /// Undistorts an image. `shift` and `out` have the size of the maps.
  template <class T>
  void apply(const ShiftGrid& shift, const ImageView<T>& image, Plane<T>* out) const;

 private:
  RectificationMaps maps_;
};

}  // namespace edgevo
