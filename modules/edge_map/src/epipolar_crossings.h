#pragma once
// The inverse depths at which the sight line of a host pixel crosses edges of like direction in another
// image.
#include <vector>

#include "depth_evidence.h"

namespace edgevo {

/// Appends them to `idepths`; false where the line is too short in this image to tell depths apart, or not in
/// it. Cost: a look into the nearest-neighbour field for each edge near the line, and one for each stretch
/// between them.
bool find_crossings(const EdgeSight& sight, const ViewGeometry& view, const SightLine& line,
                    double max_idepth, std::vector<double>* idepths);

}  // namespace edgevo
