// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The area of parts that are fixed to the camera, grown from the evidence of single edge pixels
// (ego_mask_finder.h): pixels that lie together, form something of a size and with edges of more than one
// direction, and what such a part encloses.
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// An edge pixel that may be fixed; position and unit normal in pixels of the level, strength in gray levels
/// per pixel.
struct FixedCandidate {
  float x, y, nx, ny, strength;
  /// Logarithm of the likelihood ratio: fixed over scene.
  float score = 0;
  /// Whether the present image shows it.
  bool seen = true;
  /// Direction and region of the view.
  int kind = 0;
};

/// Score of an edge that is fixed, and of a suspect. An image has 10^4 edge pixels, neighbours that depend on
/// each other.
constexpr double kFixedScore = 16, kSuspectScore = 3.5;

/// Rounds a coordinate, which is not negative: as std::lround(), without its call. The sum is exact in
/// double.
inline int nearest_pixel(float v) { return int(double(v) + 0.5); }

/// Where edges left their place recently, by blocks of the view.
class LeavingEdges {
 public:
  /// Of images of this size, pixels.
  LeavingEdges(int width = 0, int height = 0);
  /// An image later: what was counted counts less.
  void fade();
  /// An edge has left this pixel.
  void count(int x, int y) { ++left_[size_t(block(x, y))]; }
  /// 255 on blocks that edges hardly leave; empty before enough have left the others.
  Plane<uint8_t> calm() const;

 private:
  int block(int x, int y) const;
  int width_, height_, across_;
  std::vector<float> left_;
};

/// Grows the area in one image.
class FixedArea {
 public:
  /// All must outlive it. `known`: area found before, or null.
  FixedArea(const std::vector<FixedCandidate>& candidates, const ImageEdges& edges,
            const LeavingEdges& leaving, const Plane<uint8_t>* known);
  /// Area of the parts made of candidates of this score, 255 on them and a few pixels around; empty if there
  /// is none.
  Plane<uint8_t> grow(double least_score) const;

 private:
  using Candidates = std::vector<const FixedCandidate*>;
  Plane<uint8_t> with_continuations(Candidates fixed, const Plane<uint8_t>& parts) const;
  Plane<uint8_t> filled(const Plane<uint8_t>& area, const Plane<uint8_t>& near) const;
  Plane<uint8_t> hulls(const Plane<uint8_t>& area, const cv::Mat& part_at) const;
  void add_calm(const Plane<uint8_t>& within, Plane<uint8_t>* area) const;

  const std::vector<FixedCandidate>& candidates_;
  const ImageEdges& edges_;
  const LeavingEdges& leaving_;
  const Plane<uint8_t>* known_;
  int width_, height_;
};

}  // namespace edgevo
