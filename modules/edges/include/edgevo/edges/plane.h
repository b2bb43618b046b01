#pragma once
// An owned image of any element type, rows without padding. Elements are NOT initialised by the constructor: planes are
// written whole right after they are made, and clearing megabytes a frame would be wasted.
#include <cstdint>
#include <memory>

#include "edgevo/core/image.h"

namespace edgevo {

template <class T>
class Plane {
 public:
  Plane() = default;
  Plane(int width, int height) : width_(width), height_(height), data_(new T[size_t(width) * height]) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return !data_; }
  T* row(int y) { return data_.get() + size_t(y) * width_; }
  const T* row(int y) const { return data_.get() + size_t(y) * width_; }
  T& at(int x, int y) { return row(y)[x]; }
  const T& at(int x, int y) const { return row(y)[x]; }
  ImageView<T> view() const { return {data_.get(), width_, height_, width_}; }

 private:
  int width_ = 0, height_ = 0;
  std::unique_ptr<T[]> data_;
};

/// Bilinear value at (x, y); the caller keeps 0 <= x < width-1, 0 <= y < height-1.
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
