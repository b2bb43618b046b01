// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "classes.h"
#include "edgevo/core/error.h"

namespace edgevo::python {

void add_errors(py::module_& module) {
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  module.attr("InputError").attr("__doc__") =
      "Input that cannot be used: where, what is wrong, what to do. One line.";
}

void add_state(py::module_& module) {
  py::dict members;
  for (const TrackingState state : {TrackingState::kBootstrapping, TrackingState::kTracking,
                                    TrackingState::kDegraded, TrackingState::kLost})
    members[py::str(std::string(to_string(state)))] = int(state);
  module.attr("State") =
      py::module_::import("enum").attr("IntEnum")("State", members, py::arg("module") = "edgevo");
  module.attr("State").attr("__doc__") = "How reliable the pose of a frame is.";
}

py::object to_python(TrackingState state) {
  // One look-up for the process; never released, since the interpreter may end before it.
  static const auto* const states = new py::object(py::module_::import("edgevo._edgevo").attr("State"));
  return (*states)(int(state));
}

}  // namespace edgevo::python
