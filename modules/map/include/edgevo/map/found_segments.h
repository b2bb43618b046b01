// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which segments of a run have been found in a map that was kept, so that their poses in the world have its
// frame and unit.
#include <map>

#include "edgevo/map/map_event.h"

namespace edgevo {

/// Follows the events of a run.
class FoundSegments {
 public:
  /// Takes the next event.
  void apply(const MapEvent& event);
  /// Whether poses of this segment in the world are in the kept map: something of it was found there, is not
  /// withdrawn, and the epochs have been placed since it was known.
  bool contains(int segment) const;

 private:
  std::map<int, int> segment_of_;  // by keyframe
  std::map<int, int> found_;       // segment, by the constraint that says so
  int newest_placed_ = -1;         // EpochsPlaced::newest_constraint
};

}  // namespace edgevo
