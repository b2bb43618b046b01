// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Linking of the edges of a mask to chains of integer pixels.
#include <vector>

#include "edgevo/edges/image_edges.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Pixel of a mask.
struct MaskPixel {
  /// Column.
  int x;
  /// Row.
  int y;
};

/// Chains of pixels, in walking order.
struct PixelChains {
  /// Pixels of all chains, one chain after the other.
  std::vector<MaskPixel> pixels;
  /// Ranges of `pixels` that form one chain each.
  std::vector<EdgeChain> chains;

  /// Appends a chain.
  void append(const std::vector<MaskPixel>& path) {
    const int begin = int(pixels.size());
    pixels.insert(pixels.end(), path.begin(), path.end());
    chains.push_back({begin, int(pixels.size())});
  }
};

/// Chains of at least `min_chain` pixels, one pixel thick, walked as extract_edges() describes.
PixelChains link_edges(const Plane<uint8_t>& mask, int min_chain);

}  // namespace edgevo
