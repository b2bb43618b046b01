// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map file of a run that has ended, from the one that grew with it.
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/kept_map/kept_map.h"
#include "map_tables.h"

namespace edgevo {

/// The texts of a map that has just begun.
MapTexts texts_of(const MapHeader& header);
/// What a map is known by at its end.
struct MapEnd {
  /// As in KeptMap.
  std::string scale_source;
  double scale_sigma = 0;
  ImageCorrection correction;
};
/// The texts of one that is finished.
MapTexts finished_texts(MapTexts texts, const MapEnd& end);

/// The motion to the next keyframe as a constraint, `next` must be set; and back.
Constraint motion_of(const StoredKeyframe& keyframe);
NeighbourPose neighbour_of(const Constraint& motion);
/// Number of its row: below 0, so that those of the run's constraints are free.
inline int64_t number_of_motion(int keyframe) { return -1 - int64_t(keyframe); }

/// Writes a new file at `path`: the keyframes of `grown` that `run` has, where it has them. Throws
/// DatabaseError.
void write_final_map(Database* grown, const Run& run, const std::string& path);

}  // namespace edgevo
