#pragma once
// What a structured forest predicts: the edges of a patch's middle; and how two such answers are told apart.
#include <bitset>
#include <cstdint>
#include <vector>

#include "edgevo/core/random.h"

namespace edgevo::training {

constexpr int kInner = 16;                       ///< pixels a side of the part that is predicted
using EdgePatch = std::bitset<kInner * kInner>;  ///< bit row * kInner + column: an edge pixel

/// Two classes of answers, so that a common forest can be grown (Dollar and Zitnick, section 3): the patches,
/// counted in cells of 4x4 pixels, are laid along the direction in which they differ most, and parted at
/// their median. The direction is found by power iteration over at most 256 of them.
std::vector<uint8_t> two_classes(const std::vector<const EdgePatch*>& patches, Random& random);

/// The patch that differs least from the mean of all (the first of equals).
const EdgePatch& most_typical(const std::vector<const EdgePatch*>& patches);

}  // namespace edgevo::training
