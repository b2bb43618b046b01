// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a run adds to the map that it was placed in: views that the map does not have, and views that it has
// in other light only.
#include <vector>

#include "edgevo/kept_map/kept_map.h"

namespace edgevo {

/// Segments of runs, the first included, of which a map keeps records of one place.
inline constexpr int kRecordsOfPlace = 3;

/// Positions in `run` of the keyframes that `map` has no record of. A record shows half of what the keyframe
/// shows, and the other way round, in the same light: as alike as that of keyframes of one segment. In other
/// light there are up to kRecordsOfPlace of a place. Only keyframes with points, of segments that were
/// placed by a constraint of `found` to one of their keyframes. `run` lies in the frame and unit of `map`.
/// Cost: 2 us for a keyframe of the run and one of the map that look the same way.
std::vector<size_t> new_views(const KeptMap& map, const KeptMap& run, const std::vector<Constraint>& found);

/// Appends the new views of `run` to `map`, with those constraints `found` from keyframes of the map to them.
/// Returns their number.
size_t extend_map(const KeptMap& run, const std::vector<Constraint>& found, KeptMap* map);

}  // namespace edgevo
