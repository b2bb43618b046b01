// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A drawing board for procedural textures: gray and cover as floats, anti-aliased shapes, noise of several
// octaves.
//
// Coordinates are texels with (0,0) at the upper left corner of the board, not the centre of a texel. Shapes
// wrap around all four borders, so that boards tile.
#include <cstdint>
#include <functional>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/simulation/texture.h"

namespace edgevo {

class Canvas {
 public:
  Canvas(int width, int height, float gray);

  int width() const { return width_; }
  int height() const { return height_; }
  float& at(int x, int y) { return gray_[size_t(y) * width_ + x]; }
  float at(int x, int y) const { return gray_[size_t(y) * width_ + x]; }

  /// Makes the board a cut-out, at first empty; shapes then also add cover.
  void cut_out();
  /// Removes cover where `removed`, a function of (x, y), is true.
  void cut_where(const std::function<bool(double, double)>& removed);

  /// Blends `gray` over the rectangle [x0, x1) x [y0, y1).
  void rect(double x0, double y0, double x1, double y1, float gray, float opacity = 1);
  /// A raised rectangle with a light upper left and a dark lower right rim of `rim` texels.
  void panel(double x0, double y0, double x1, double y1, float gray, double rim, float relief);
  /// An ellipse with half axes a, b, rotated by `angle` radians.
  void ellipse(double cx, double cy, double a, double b, double angle, float gray, float opacity = 1);
  /// A straight stroke.
  void line(double x0, double y0, double x1, double y1, double width, float gray, float opacity = 1);

  /// Adds tileable noise: octaves from `cells` across the width on, each twice as fine and `gain` times as
  /// strong; the sum has a range of about +-amplitude. The factor `elongation` lengthens it along y.
  void noise(Random& random, int cells, int octaves, float amplitude, float gain = 0.6f, int elongation = 1);
  /// Adds a random value within +-amplitude to each texel.
  void grain(Random& random, float amplitude);
  /// Multiplies by a factor that changes linearly from `top` to `bottom`.
  void fade(float top, float bottom);

  Texture texture() const;

 private:
  void blend(int x, int y, float gray, float opacity);

  int width_, height_;
  std::vector<float> gray_, cover_;
};

/// Draws marks that look like lines of writing in the rectangle; `line` is the height of a line in texels.
void write_text(Canvas* canvas, Random& random, double x0, double y0, double x1, double y1, double line,
                float ink);

}  // namespace edgevo
