#pragma once
// Edge pixels by a probability: the image's own gradient says where an edge lies, the probability which of
// them are edges.
//
// A probability is thick, and its ridge lies a pixel or two beside the edge (networks work on coarser grids,
// forests add up patches); the gradient's maximum lies where Canny's edges do, within a tenth of a pixel. And
// what a network calls 0.5 is another thing from network to network and from light to light. So candidates
// are lines of gradient maxima, each is scored by the largest probability across it, and only the order of
// the scores counts: as many are kept as there would be of Canny's.
#include "edgevo/edges/edge_params.h"
#include "edgevo/edges/gradient.h"

namespace edgevo {

/// Marked pixels of a mask.
int count_marked(const Plane<uint8_t>& mask);

/// Of `candidates` (a mask of gradient maxima), those with the highest scores: weak ones are the first
/// `budget` of them, strong ones the first half of these; weak ones stay where they are linked to a strong
/// one. A score is the largest probability within two pixels across the edge; 0 is never an edge. Mask, 255
/// at edge pixels. Cost: 3 ms at 1241x376.
Plane<uint8_t> most_probable(const Plane<uint8_t>& candidates, const Gradient& gradient,
                             const ImageView<uint8_t>& probability, int budget);

}  // namespace edgevo
