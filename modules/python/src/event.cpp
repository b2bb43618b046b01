// SPDX-License-Identifier: BSD-3-Clause
#include "event.h"

#include "arrays.h"
#include "classes.h"
#include "edgevo/core/formatted.h"

namespace edgevo::python {
namespace {

struct Converter {
  int newest;

  using Result = std::optional<PyEvent>;
  Result operator()(const SegmentPlaced& e) const {
    return PyEvent{"segment", newest, e.segment, e.T_world_map.rigid, e.T_world_map.scale};
  }
  Result operator()(const EpochBegan& e) const { return PyEvent{"epoch", newest, e.segment}; }
  Result operator()(const EpochsPlaced& e) const {
    return PyEvent{"placed", newest, e.segment, e.T_world_odom};
  }
  Result operator()(const KeyframeAdded& e) const { return PyEvent{"keyframe", e.frame_index, e.segment}; }
  Result operator()(const MapMoved& e) const {
    return PyEvent{"map_moved",
                   newest,
                   e.segment,
                   std::nullopt,
                   std::numeric_limits<double>::quiet_NaN(),
                   e.reason == MoveReason::kCamera ? "the camera was corrected" : "the past was corrected"};
  }
  // Only of frames before the newest, whose record does not have it.
  Result operator()(const FrameAnchored& e) const {
    if (e.frame.index >= newest || !e.frame.T_world_cam_live) return std::nullopt;
    return PyEvent{"pose", e.frame.index, e.frame.segment, e.frame.T_world_cam_live};
  }
  template <class Other>
  Result operator()(const Other&) const {
    return std::nullopt;
  }
};

}  // namespace

std::optional<PyEvent> to_event(const MapEvent& event, int newest) {
  return std::visit(Converter{newest}, event);
}

PyEvent state_event(const FrameRecord& record) {
  PyEvent event{"state", record.index, record.segment, record.T_world_cam_live};
  event.text = std::string(to_string(record.state)) + (record.note.empty() ? "" : ": " + record.note);
  return event;
}

void add_event(py::module_& module) {
  py::class_<PyEvent> event(
      module, "Event",
      "What happened, for on_event.\n\n"
      "kind: \"state\" (it changed; text), \"pose\" (T_world_cam of an earlier frame was found),\n"
      "\"keyframe\", \"segment\" (a map began; T, scale: from it to the world), \"epoch\" (the unit of "
      "length\n"
      "may have changed), \"placed\" (the world was placed anew; T: from the frame of live poses to it),\n"
      "\"map_moved\" (text: why).");
  event.def_readonly("kind", &PyEvent::kind, "See above.");
  event.def_readonly("frame", &PyEvent::frame, "Index of the frame.");
  event.def_readonly("segment", &PyEvent::segment, "Number of the segment; -1: none.");
  event.def_property_readonly(
      "T", [](const PyEvent& e) { return to_array(e.T); }, "A pose, 4 x 4, or None.");
  event.def_readonly("scale", &PyEvent::scale, "A ratio of lengths; NaN: none.");
  event.def_readonly("text", &PyEvent::text, "In words; may be empty.");
  event.def("__repr__", [](const PyEvent& e) {
    return formatted("Event(%s, frame=%d, segment=%d%s)", e.kind.c_str(), e.frame, e.segment,
                     e.text.empty() ? "" : (", " + e.text).c_str());
  });
}

}  // namespace edgevo::python
