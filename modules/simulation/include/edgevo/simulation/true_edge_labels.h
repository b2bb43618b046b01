// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ground truth of the edges of a rendered frame and their kinds, to train and to evaluate detectors.
//
// Derived from the scene's geometry, not from the image: independent of noise, light and blur.
//   depth step  a surface ends before another one, or before the sky, however small the step is
//   crease      two surfaces meet in the line where their planes intersect
//   texture     the gray of one surface, or of several in one plane, changes: a local maximum, across the
//               edge, of the slope of the clean image (no noise, an instantaneous shutter)
// A pixel is a depth step or a crease if that line passes through its square, as sampled at nine points: one
// or two pixels thick, unbiased. The edge of a texture is one pixel thick. Labels are those of the
// UNDISTORTED image at the middle of the exposure, as depth is. Where kinds meet in a pixel, the first of the
// list wins.
//
// As a file (edges/000000.png): an 8-bit gray image of these values, so that any viewer shows them.
#include <cstdint>

#include "edgevo/core/image.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Kind of edge at a pixel of a rendered image.
enum class TrueEdge : uint8_t { none = 0, texture = 85, crease = 170, depth_step = 255 };

/// Slope of the clean image, gray levels per pixel, from which a change of gray is an edge of texture: the
/// least gradient that detectors accept by default (`edges.min_gradient`).
constexpr float kMinTextureSlope = 3;

/// Labels of frame `index`, 0 <= index < renderer.size(): TrueEdge as gray. Any thread. Cost: two renderings.
GrayImage true_edge_labels(const SceneRenderer& renderer, int index);

}  // namespace edgevo
