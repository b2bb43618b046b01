#pragma once
// An owned image of any element type, rows without padding. Elements are NOT initialised by the constructor: planes are
// written whole right after they are made, and clearing megabytes a frame would be wasted. Their memory is kept for the next
// plane of the same size: a frame needs some ten of them, and fresh memory costs more than a gradient does.
#include <cstdint>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "edgevo/core/image.h"

namespace edgevo {

/// Memory of planes, used again. Any thread.
struct PlaneMemory {
  /// A block of `bytes`, not initialised. Throws std::bad_alloc.
  static void* take(size_t bytes);
  /// Keeps the block for the next `take` of that size, or frees it where many are kept.
  static void give_back(void* block, size_t bytes);
};

/// An owned image of trivial elements; see above.
template <class T>
class Plane {
  static_assert(std::is_trivial_v<T>);

 public:
  Plane() = default;
  /// Elements are not initialised.
  Plane(int width, int height) : width_(width), height_(height), data_(static_cast<T*>(PlaneMemory::take(sizeof(T) * width * height)), GiveBack{sizeof(T) * width * height}) {}

  int width() const { return width_; }  ///< pixels
  int height() const { return height_; }  ///< pixels
  bool empty() const { return !data_; }  ///< no image
  T* row(int y) { return data_.get() + size_t(y) * width_; }  ///< 0 <= y < height, not checked
  const T* row(int y) const { return data_.get() + size_t(y) * width_; }  ///< 0 <= y < height, not checked
  T& at(int x, int y) { return row(y)[x]; }  ///< inside the image, not checked
  const T& at(int x, int y) const { return row(y)[x]; }  ///< inside the image, not checked
  /// valid while this object lives
  ImageView<T> view() const { return {data_.get(), width_, height_, width_}; }

 private:
  int width_ = 0, height_ = 0;
  struct GiveBack {
    size_t bytes = 0;
    void operator()(T* block) const { PlaneMemory::give_back(block, bytes); }
  };
  std::unique_ptr<T[], GiveBack> data_;
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
