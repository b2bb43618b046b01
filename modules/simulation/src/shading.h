// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Brightness of one surface at one pixel: the texture averaged over the pixel's footprint.
#include "edgevo/simulation/light.h"
#include "view.h"

namespace edgevo {

/// Parameters of shading other than the surface.
struct ShadingContext {
  /// Size of a pixel in normalised coordinates: 1/fx, 1/fy.
  float pixel_x = 0, pixel_y = 0;
  float haze_gray = 0, haze_per_metre = 0;
  /// Factor on the whole image.
  float exposure = 1;
  /// Shadows on the ground before and after a change of light, each with its weight; null: none.
  const GroundShadow* shadows[2] = {nullptr, nullptr};
  float weights[2] = {0, 0};
  /// Position of the camera, x and y in scene axes, metres.
  Eigen::Vector2f eye = {0, 0};
};

/// Gray (0..255, not clamped) where the ray (x, y, 1) meets the surface.
float shade(const ViewSurface& view, const ShadingContext& context, float x, float y);

/// Gray of the sky; `view` is the cloud layer.
float shade_sky(const ViewSurface& view, const ShadingContext& context, float x, float y);

}  // namespace edgevo
