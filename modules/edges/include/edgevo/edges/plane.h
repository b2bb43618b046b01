// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An owned image of any element type, rows without padding. The constructor does NOT initialise the elements:
// planes are written completely right after construction, and clearing megabytes per frame would be wasted.
// Their memory is reused by the next plane of the same size: a frame needs about ten of them, and fresh
// memory costs more than computing a gradient.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "edgevo/core/image.h"

namespace edgevo {

/// Memory pool of planes. Thread-safe.
struct PlaneMemory {
  /// Returns an uninitialised block of `bytes`. Throws std::bad_alloc.
  static void* take(size_t bytes);
  /// Keeps the block for the next take() of that size, or frees it if many are kept already.
  static void give_back(void* block, size_t bytes);
};

/// Owned image of trivial elements, rows without padding.
template <class T>
class Plane {
  static_assert(std::is_trivial_v<T>);

 public:
  Plane() = default;
  /// Allocates a plane; its elements are not initialised.
  Plane(int width, int height)
      : width_(width),
        height_(height),
        data_(static_cast<T*>(PlaneMemory::take(sizeof(T) * width * height)),
              GiveBack{sizeof(T) * width * height}) {}

  /// Width, pixels.
  int width() const { return width_; }
  /// Height, pixels.
  int height() const { return height_; }
  /// Whether there is no image.
  bool empty() const { return !data_; }
  /// First pixel of a row, 0 <= y < height (not checked).
  T* row(int y) { return data_.get() + size_t(y) * width_; }
  /// First pixel of a row, 0 <= y < height (not checked).
  const T* row(int y) const { return data_.get() + size_t(y) * width_; }
  /// Pixel inside the image (not checked).
  T& at(int x, int y) { return row(y)[x]; }
  /// Pixel inside the image (not checked).
  const T& at(int x, int y) const { return row(y)[x]; }
  /// View of the plane, valid while this object lives.
  ImageView<T> view() const { return {data_.get(), width_, height_, width_}; }

 private:
  int width_ = 0, height_ = 0;
  struct GiveBack {
    size_t bytes = 0;
    void operator()(T* block) const { PlaneMemory::give_back(block, bytes); }
  };
  std::unique_ptr<T[], GiveBack> data_;
};

/// Bilinear interpolation at (x, y); requires 0 <= x < width - 1 and 0 <= y < height - 1.
template <class T>
inline float bilinear(const ImageView<T>& image, float x, float y) {
  const int x0 = int(x), y0 = int(y);
  const float fx = x - float(x0), fy = y - float(y0);
  const T* p = image.data + y0 * image.stride + x0;
  const T* q = p + image.stride;
  const float top = float(p[0]) + fx * (float(p[1]) - float(p[0]));
  const float bottom = float(q[0]) + fx * (float(q[1]) - float(q[0]));
  return top + fy * (bottom - top);
}

}  // namespace edgevo
