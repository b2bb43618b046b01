// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Edge pixels selected by a probability: the gradient of the image gives the positions, the probability
// decides which are edges.
//
// A probability is wide, and its ridge lies a pixel or two next to the edge (networks use coarser grids,
// forests add up patches); the maximum of the gradient agrees with Canny within a tenth of a pixel. And a
// probability of 0.5 means different things for different networks and in different light. So the candidates
// are lines of gradient maxima, each scored by the largest probability across it, and only the order of the
// scores counts: as many pixels are kept as Canny would find.
//
// Whole chains are kept or dropped by their mean score: selected pixel by pixel, lines would break where a
// score is close to the threshold, in each frame elsewhere (lab 2026-11-24_whole_chains).
#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Number of pixels of a mask that remain after thinning and linking, without chains below `min_chain`
/// pixels.
int count_linked(const Plane<uint8_t>& mask, int min_chain);

/// Selects the chains of `candidates` (a mask of gradient maxima; at least `min_chain` pixels each) with the
/// highest mean scores until they have `budget` pixels, and returns their mask, 255 at edge pixels. The score
/// of a pixel is the largest probability within two pixels across the edge; a chain of zeros is never an
/// edge. Cost at 1241x376: 3 ms for the scores, plus linking of all candidates (edge_extraction.h).
Plane<uint8_t> most_probable(const Plane<uint8_t>& candidates, const Gradient& gradient,
                             const ImageView<uint8_t>& probability, int budget, int min_chain);

}  // namespace edgevo
