#pragma once
// Gray textures with mip levels and, for leaves, car outlines and the like, a cut-out mask.
//
// A surface seen from afar must be averaged before it is sampled: a brick wall at 80 m that is point-sampled flickers and
// gives edges that no camera would see. Each texture therefore holds its own pyramid of 2x2 averages; the renderer
// picks the level by the footprint of the pixel.
#include <cstdint>
#include <vector>

#include "edgevo/core/image.h"

namespace edgevo {

/// One level of a texture.
struct TextureLevel {
  int width = 0, height = 0;  ///< texels
  std::vector<uint8_t> gray;   ///< width * height
  std::vector<uint8_t> alpha;  ///< empty (opaque everywhere) or width * height; the surface exists where alpha >= 128
};

/// Level 0 has power-of-two sides; each further level halves both until one of them is a single texel.
struct Texture {
  std::vector<TextureLevel> levels;  ///< the finest first

  int width() const { return levels.front().width; }  ///< texels of level 0
  int height() const { return levels.front().height; }  ///< texels of level 0
  bool is_cut_out() const { return !levels.front().alpha.empty(); }  ///< it has holes
};

/// Builds the levels. `alpha` is empty or as large as the image. Averages of gray count only texels that exist, so that
/// nothing bleeds in through a cut-out's border. Throws InputError if a side is no power of two.
Texture make_texture(const GrayImage& gray, const std::vector<uint8_t>& alpha = {});

}  // namespace edgevo
