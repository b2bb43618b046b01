// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What happens during a run, for the callback on_event: the map events that a program acts on, and changes of
// the state, as one kind of value.
#include <limits>
#include <optional>
#include <string>

#include "edgevo/core/records.h"
#include "edgevo/map/map_event.h"

namespace edgevo::python {

/// An event; what it has not stays at its default.
struct PyEvent {
  /// "state", "pose", "keyframe", "segment", "epoch", "placed" or "map_moved".
  std::string kind;
  /// Index of the frame that it is about, or after which it came.
  int frame = -1;
  /// Number of the segment; -1: none.
  int segment = -1;
  /// A pose; see add_event().
  std::optional<SE3> T = std::nullopt;
  /// A ratio of lengths.
  double scale = std::numeric_limits<double>::quiet_NaN();
  /// In words.
  std::string text = {};
};

/// The event as Python has it; nothing for those that no program acts on. `newest`: the newest frame.
std::optional<PyEvent> to_event(const MapEvent& event, int newest);

/// The state of a frame that differs from the one before.
PyEvent state_event(const FrameRecord& record);

}  // namespace edgevo::python
