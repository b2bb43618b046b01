// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Inverse depths at which the sight line of a host pixel crosses edges of like direction in another image.
#include <vector>

#include "depth_evidence.h"

namespace edgevo {

/// Appends the inverse depths of the crossings to `idepths`. False if the line lies outside this image or is
/// too short in it to distinguish depths. Cost: one look-up in the nearest-neighbour field per edge near the
/// line, and one per gap between them.
bool find_crossings(const EdgeSight& sight, const ViewGeometry& view, double max_idepth,
                    std::vector<double>* idepths);

}  // namespace edgevo
