#pragma once
// Edges of a mask as chains of whole pixels.
#include <vector>

#include "edgevo/edges/edge_map.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// A pixel of a mask.
struct MaskPixel {
  int x;  ///< column
  int y;  ///< row
};

/// Pixels chain by chain, in walking order.
struct PixelChains {
  std::vector<MaskPixel> pixels;  ///< of all chains
  std::vector<EdgeChain> chains;  ///< ranges of `pixels`

  /// One more chain.
  void append(const std::vector<MaskPixel>& path) {
    const int begin = int(pixels.size());
    pixels.insert(pixels.end(), path.begin(), path.end());
    chains.push_back({begin, int(pixels.size())});
  }
};

/// Chains of at least `min_chain` pixels, one pixel thick (edge_extraction.h tells how they are walked).
PixelChains link_edges(const Plane<uint8_t>& mask, int min_chain);

}  // namespace edgevo
