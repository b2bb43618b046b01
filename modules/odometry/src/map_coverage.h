#pragma once
// Is the map out of view? A rotation can be followed with points of unknown depth, a
// translation only while what is left of the map explains the images. Where it does not, a new map is worth
// more than the old one (share/lab/archive/2026-11-22_rotation_on_the_spot.md).
#include <optional>

#include "edgevo/alignment/tracker.h"
#include "edgevo/odometry/odometry_params.h"
#include "state_machine.h"

namespace edgevo {

struct Reference;

class MapCoverage {
 public:
  explicit MapCoverage(const RecoveryParams& params) : bootstrap_out_of_view_(params.bootstrap_out_of_view) {}

  /// After each frame with a pose: Event::kOutOfView, Event::kInView, or nothing where neither is certain.
  std::optional<Event> look(const Reference& reference, const TrackResult& tracked);
  /// A new map.
  void restart() { unexplained_frames_ = 0; }

 private:
  bool bootstrap_out_of_view_;
  int unexplained_frames_ = 0;  ///< more frames of late that the map does not explain than others
};

}  // namespace edgevo
