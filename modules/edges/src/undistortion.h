#pragma once
// An image as a pinhole would have seen it: each pixel fetched from where the lens put it.
#include <cstdint>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Bilinear, positions rounded to 1/128 px; beyond the border the border pixels go on. At least 2x2 pixels.
/// Faster than OpenCV's remap, whose positions are rounded to 1/32 px.
class Undistortion {
 public:
  explicit Undistortion(const UndistortionMaps& maps);
  /// `image` and `out` have the size of the maps.
  void apply(const ImageView<uint8_t>& image, Plane<uint8_t>* out) const;

 private:
  int width_, height_;
  std::vector<int32_t> corner_;        // per pixel: upper left of the four around its position, x + y * width
  std::vector<uint8_t> right_, down_;  // from there, in 1/128 px, 0..128
};

/// A smooth shift of an image of width x height, given at nodes kCell pixels apart that reach over its
/// border.
class ShiftGrid {
 public:
  static constexpr int kCell = 16;  ///< pixels: over so few the shift by a smooth motion is nearly linear
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

/// As Undistortion, with a further shift in the raw image that is another for each one: a rolling shutter.
/// Slower: positions are computed again.
class ShiftedUndistortion {
 public:
  explicit ShiftedUndistortion(UndistortionMaps maps) : maps_(std::move(maps)) {}
  /// `image` and `out` have the size of the maps, as `shift` has.
  void apply(const ShiftGrid& shift, const ImageView<uint8_t>& image, Plane<uint8_t>* out) const;

 private:
  UndistortionMaps maps_;
};

}  // namespace edgevo
