// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How well an image was exposed and how sharp its edges are, for FrameEvidence (core/frame_evidence.h).
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Share of the pixels of the raw image within 2 gray levels of black or of white (with more than 8 bits, at
/// an end of the camera's values), 0 to 1; every sixteenth
/// row is counted, without the border mask. NaN if no pixel is counted. Cost: 0.02 ms at 640x480.
double saturated_share(const FramePyramid& pyramid);

/// Blur of the edges: median ratio of the gradient at an edge on the second level to that on the finest, both
/// per pixel of the finest. The smoothing of the second level weakens a sharp edge more than a blurred one
/// (as in Zhuo and Sim, Defocus map estimation from a single image, 2011): 0.46 for a sharp step, 0.7 for one
/// blurred by a Gaussian of 2 pixels, towards 1 for more; less than 0.46 where edges are thin lines. A motion
/// blur counts where it crosses edges. NaN with fewer than 100 edge pixels, or with edges on one level only.
/// Cost: 0.03 ms at 640x480.
double edge_blur(const FramePyramid& pyramid);

}  // namespace edgevo
