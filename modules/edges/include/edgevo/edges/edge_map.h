#pragma once
// The edges of one image: thin, sub-pixel, with direction, and linked along the edge.
//
// Pixels are stored chain by chain, in the order in which one walks along the edge, so that the two neighbours of pixel i
// on its edge are i-1 and i+1 wherever both belong to the same chain.
#include <Eigen/Core>
#include <vector>

namespace edgevo {

/// Pixels. Nearer to the border no edges are taken: their gradient rests on pixels that the image does not
/// have.
constexpr int kEdgelessBorder = 2;

/// One pixel of an edge.
struct EdgePixel {
  float x = 0, y = 0;    ///< sub-pixel position, (0,0) = centre of the top-left pixel
  float nx = 0, ny = 0;  ///< unit gradient g: the edge normal, pointing from dark to bright
  float strength = 0;    ///< gradient magnitude at the edge, in gray levels per pixel
  int chain = 0;         ///< index into EdgeMap::chains

  Eigen::Vector2f position() const { return {x, y}; }  ///< (x, y), pixels
  Eigen::Vector2f normal() const { return {nx, ny}; }  ///< unit gradient, from dark to bright
  /// Edge direction g_perp: the normal turned by +90 degrees.
  Eigen::Vector2f direction() const { return {-ny, nx}; }
};

/// Pixels [begin, end) of EdgeMap::pixels form one edge.
struct EdgeChain {
  int begin = 0, end = 0;  ///< first pixel, and the one after the last
  int length() const { return end - begin; }  ///< pixels
};

/// The edges of one image.
struct EdgeMap {
  int width = 0, height = 0;  ///< of the image, pixels
  std::vector<EdgePixel> pixels;  ///< chain by chain
  std::vector<EdgeChain> chains;  ///< ascending in `begin`; together they hold all pixels

  /// Neighbour of pixel i in `step` = +1 or -1 along its edge; -1 at the end of the edge.
  int neighbour(int i, int step) const {
    const int j = i + step;
    const EdgeChain& c = chains[pixels[i].chain];
    return j >= c.begin && j < c.end ? j : -1;
  }
};

}  // namespace edgevo
