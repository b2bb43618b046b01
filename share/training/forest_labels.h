// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Labels of a structured forest, the edges at the centre of a patch, and their division into classes.
#include <bitset>
#include <cstdint>
#include <vector>

#include "edgevo/core/random.h"

namespace edgevo::training {

/// Side of the predicted centre, pixels.
constexpr int kInner = 16;
/// Label of a patch: bit row * kInner + column marks an edge pixel.
using EdgePatch = std::bitset<kInner * kInner>;

/// Divides labels into two classes, so that an ordinary forest can be grown (Dollar and Zitnick, section 3):
/// the patches, counted in cells of 4x4 pixels, are projected onto the direction in which they differ most
/// and split at their median. The direction is found by power iteration over at most 256 of them.
std::vector<uint8_t> two_classes(const std::vector<const EdgePatch*>& patches, Random& random);

/// Patch that differs least from the mean of all, the first one on a tie.
const EdgePatch& most_typical(const std::vector<const EdgePatch*>& patches);

}  // namespace edgevo::training
