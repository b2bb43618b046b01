// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gray textures with mip levels and, for leaves, car outlines and similar shapes, a cut-out mask.
//
// A surface seen from afar must be averaged before it is sampled: a brick wall at 80 m that is point-sampled
// flickers and has edges that no camera would see. Each texture therefore holds its own pyramid of 2x2
// averages; the renderer picks the level by the footprint of the pixel.
#include <cstdint>
#include <vector>

#include "edgevo/core/image.h"

namespace edgevo {

/// One level of a texture.
struct TextureLevel {
  /// Size, texels.
  int width = 0, height = 0;
  /// Gray values, width * height.
  std::vector<uint8_t> gray;
  /// Mask, empty (opaque everywhere) or width * height; the surface exists where alpha >= 128.
  std::vector<uint8_t> alpha;
};

/// A pyramid: level 0 has power-of-two sides; each further level halves both until one of them is a single
/// texel.
struct Texture {
  /// Levels, the finest first.
  std::vector<TextureLevel> levels;

  /// Width of level 0, texels.
  int width() const { return levels.front().width; }
  /// Height of level 0, texels.
  int height() const { return levels.front().height; }
  /// True if it has holes.
  bool is_cut_out() const { return !levels.front().alpha.empty(); }
};

/// Builds the levels. `alpha` is empty or as large as the image. Averages of gray include only existing
/// texels, so that nothing bleeds in at the border of a cut-out. Throws InputError if a side is not a power
/// of two.
Texture make_texture(const GrayImage& gray, const std::vector<uint8_t>& alpha = {});

}  // namespace edgevo
