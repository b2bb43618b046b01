#pragma once
// Edge pixels by a probability: the image's own gradient says where an edge lies, the probability which of
// them are edges.
//
// A probability is thick, and its ridge lies a pixel or two beside the edge (networks work on coarser grids,
// forests add up patches); the gradient's maximum lies where Canny's edges do, within a tenth of a pixel. And
// what a network calls 0.5 is another thing from network to network and from light to light. So candidates
// are lines of gradient maxima, each is scored by the largest probability across it, and only the order of
// the scores counts: as many pixels are kept as there would be of Canny's.
//
// Whole chains are kept or not, by their mean score: chosen pixel by pixel, lines break where a score lies
// next to the threshold, in each frame elsewhere (share/lab/archive/2026-11-24_whole_chains.md).
#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Pixels of a mask that are left when it is thinned and linked, without chains under `min_chain` pixels.
int count_linked(const Plane<uint8_t>& mask, int min_chain);

/// Of the chains of `candidates` (a mask of gradient maxima; at least `min_chain` pixels each), those with
/// the highest mean scores, until they have `budget` pixels. A pixel's score is the largest probability
/// within two pixels across the edge; a chain of zeros is never an edge. Mask, 255 at edge pixels. Cost at
/// 1241x376: 3 ms for the scores, and linking all candidates (edge_extraction.h).
Plane<uint8_t> most_probable(const Plane<uint8_t>& candidates, const Gradient& gradient,
                             const ImageView<uint8_t>& probability, int budget, int min_chain);

}  // namespace edgevo
