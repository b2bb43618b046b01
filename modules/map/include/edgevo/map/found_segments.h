// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which segments of a run have been found in a map that was kept, so that their poses in the world have its
// frame and unit.
#include <map>
#include <set>

#include "edgevo/map/map_event.h"

namespace edgevo {

/// Follows the events of a run.
class FoundSegments {
 public:
  /// Takes the next event.
  void apply(const MapEvent& event);
  /// Whether poses of this segment in the world are in the kept map: something of it was found there, and the
  /// epochs have been placed since.
  bool contains(int segment) const { return placed_.count(segment) > 0; }

 private:
  std::map<int, int> segment_of_;  // by keyframe
  std::set<int> found_, placed_;   // before and after the poses say so
};

}  // namespace edgevo
