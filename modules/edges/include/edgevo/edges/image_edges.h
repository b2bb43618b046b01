// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The edges of one image: thin, with sub-pixel positions and directions, linked along the edge.
//
// Pixels are stored chain by chain, in the order in which one walks along the edge, so that the two
// neighbours of pixel i on its edge are i-1 and i+1 wherever both belong to the same chain.
#include <Eigen/Core>
#include <vector>

namespace edgevo {

/// Width of the border without edges, pixels: the gradient there depends on pixels outside the image.
constexpr int kEdgelessBorder = 2;

/// Pixel of an edge.
struct EdgePixel {
  /// Sub-pixel position; (0, 0) is the centre of the top-left pixel.
  float x = 0, y = 0;
  /// Unit gradient g: the edge normal, pointing from dark to bright.
  float nx = 0, ny = 0;
  /// Gradient magnitude at the edge, in gray levels per pixel.
  float strength = 0;
  /// Index into ImageEdges::chains.
  int chain = 0;

  /// Position (x, y), pixels.
  Eigen::Vector2f position() const { return {x, y}; }
  /// Edge normal: unit gradient, from dark to bright.
  Eigen::Vector2f normal() const { return {nx, ny}; }
  /// Edge direction g_perp: the normal turned by +90 degrees.
  Eigen::Vector2f direction() const { return {-ny, nx}; }
};

/// One edge: pixels [begin, end) of ImageEdges::pixels.
struct EdgeChain {
  /// Index of the first pixel, and of the one after the last.
  int begin = 0, end = 0;
  /// Number of pixels.
  int length() const { return end - begin; }
};

/// The edges of one image.
struct ImageEdges {
  /// Size of the image, pixels.
  int width = 0, height = 0;
  /// Edge pixels, chain by chain.
  std::vector<EdgePixel> pixels;
  /// Chains in ascending order of `begin`; together they cover all pixels.
  std::vector<EdgeChain> chains;

  /// Neighbour of pixel i in `step` = +1 or -1 along its edge; -1 at the end of the edge.
  int neighbour(int i, int step) const {
    const int j = i + step;
    const EdgeChain& c = chains[pixels[i].chain];
    return j >= c.begin && j < c.end ? j : -1;
  }
};

}  // namespace edgevo
