// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frames of a bootstrap that were located in a map that was kept.
#include <map>
#include <optional>

#include "edgevo/core/timestamp.h"
#include "edgevo/gyro/gyro_model.h"
#include "edgevo/map/located_pose.h"
#include "edgevo/map/map_event.h"
#include "edgevo/mapping/bootstrap.h"

namespace edgevo {

/// The frames since the last map. For one thread.
class LocatedViews {
 public:
  /// Adds a frame.
  void add(int frame_index, Timestamp time, const LocatedPose& found) { views_[frame_index] = {time, found}; }
  /// Forgets all. Returns whether there were some.
  bool clear();
  /// Rotation of the camera between the times of two of them; nothing if one of the two was not located.
  std::optional<CameraTurn> turn_between(Timestamp begin, Timestamp end) const;
  /// Where a map of these views lies in the kept map: by the view that was located, or that is nearest to a
  /// frame that was, the newest of them. Nothing if none was.
  std::optional<SegmentPlaced> place(int segment, const BootstrapResult& views) const;

 private:
  struct Located {
    Timestamp time;
    LocatedPose pose;
  };
  std::map<int, Located> views_;  // by frame
};

}  // namespace edgevo
