// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A bound on the number of edge pixels of an image.
#include "edgevo/edges/edge_links.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Most edge pixels of an image. 45,000 are the most that a recording of measured accuracy shows, a road
/// among trees at 1241x376; depth, lines and memory grow with each one.
constexpr int kMaxEdgePixels = 48000;

/// `all` if these are at most `most` pixels, else about as many, in the same order. Chains are kept whole,
/// since what is chosen pixel by pixel is not found again in the next image. The image is divided into cells,
/// of which each may hold equally many pixels: a cell with fewer keeps them all, and where grass or foliage
/// fills a cell its weakest chains go. Cost: 1 to 3 ms where something goes, else nothing.
PixelChains within_quota(PixelChains all, const Gradient& gradient, int most = kMaxEdgePixels);

}  // namespace edgevo
