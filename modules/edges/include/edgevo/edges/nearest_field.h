// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Nearest-neighbour field: for each pixel of an image, the index of the nearest edge pixel within a radius.
//
// Exact (Euclidean distance between integer pixel positions; ties go to the upper row, then to the left), up
// to `radius`. Separable: first the nearest edge within each row, then for each pixel the best of the 2
// radius + 1 rows around it; the second step is a minimum over 16-bit keys (squared distance, row offset,
// side), which compilers vectorise. Only the key is stored: squared distance and row give the column offset.
// Cost at 1241x376, radius 12: about 1 ms on one core, independent of the number of edges.
#include <cmath>

#include "edgevo/core/simd.h"
#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Finds the edge pixel nearest to a position in constant time.
class NearestField {
 public:
  /// Largest radius, pixels: squared distance, row offset and side must fit 15 bits.
  static constexpr int kMaxRadius = 15;
  /// Bits of the row offset.
  static constexpr int kRowBits = 5;
  /// Position of the squared distance in a key; the lowest bit is the side.
  static constexpr int kShift = kRowBits + 1;

  NearestField() = default;
  /// Builds the field for a `radius` of 1 to kMaxRadius pixels. Edge positions are rounded to integer pixels.
  NearestField(const ImageEdges& edges, int radius);

  /// Radius, pixels.
  int radius() const { return radius_; }
  /// Index into ImageEdges::pixels of the edge pixel nearest to (x, y), rounded to integer pixels; -1 if
  /// there is none within the radius or (x, y) lies outside the image.
  int nearest(float x, float y) const {
    const int pixel = nearest_pixel(x, y);
    return pixel < 0 ? -1 : edge_at(pixel);
  }
  /// Index of the edge pixel nearest to an integer pixel inside the image; -1 if there is none within the
  /// radius.
  int nearest_at(int x, int y) const {
    const int pixel = nearest_pixel_at(x, y);
    return pixel < 0 ? -1 : edge_at(pixel);
  }
  /// Squared distance from (x, y), rounded to integer pixels, to the pixel of the nearest edge; radius^2 + 1
  /// if there is none within the radius or (x, y) lies outside the image.
  int squared_distance(float x, float y) const {
    if (!contains(x, y)) return none_ >> kShift;
    return std::min<int>(keys_.at(int(x + 0.5f), int(y + 0.5f)), none_) >> kShift;
  }

  /// Squared distance from an integer pixel inside the image (not checked), otherwise as squared_distance().
  int squared_distance_at(int x, int y) const { return std::min<int>(keys_.at(x, y), none_) >> kShift; }

  /// First half of nearest(), for callers that prefetch memory for many look-ups: row * width + column of the
  /// pixel of the nearest edge; -1 as for nearest().
  int nearest_pixel(float x, float y) const {
    return contains(x, y) ? nearest_pixel_at(int(x + 0.5f), int(y + 0.5f)) : -1;
  }
  /// Second half of nearest(): index of the edge pixel at such a pixel.
  int edge_at(int pixel) const { return index_.row(0)[pixel]; }
  /// Prefetches what nearest_pixel() will read.
  void prefetch_pixel(float x, float y) const {
    if (contains(x, y)) prefetch(&keys_.at(int(x + 0.5f), int(y + 0.5f)));
  }
  /// Prefetches what edge_at() will read.
  void prefetch_edge(int pixel) const { prefetch(index_.row(0) + pixel); }

 private:
  // Whether (x, y) rounds to a pixel of the image.
  bool contains(float x, float y) const {
    return x > -0.5f && y > -0.5f && x < float(keys_.width()) - 0.5f && y < float(keys_.height()) - 0.5f;
  }
  int nearest_pixel_at(int x, int y) const {
    const int key = keys_.at(x, y);
    if (key >= none_) return -1;
    const int down = (key >> 1 & ((1 << kRowBits) - 1)) - radius_;
    const int across = int(std::sqrt(float((key >> kShift) - down * down)));  // exact: it is a square number
    return (y + down) * keys_.width() + (key & 1 ? x - across : x + across);
  }

  int radius_ = 0;
  int none_ = 0;         // smallest key that means no edge within the radius
  Plane<int16_t> keys_;  // 64 * squared distance + 2 * (row offset + radius) + 1 if the edge lies to the left
  Plane<int32_t> index_;  // edge pixel index; valid only at edge pixels
};

}  // namespace edgevo
