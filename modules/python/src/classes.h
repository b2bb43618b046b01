// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What each source file of this folder adds to the module, in the order in which they need one another.
#include <pybind11/pybind11.h>

#include "edgevo/core/tracking_state.h"

namespace edgevo::python {

namespace py = pybind11;

/// InputError.
void add_errors(py::module_& module);
/// State, an enum.IntEnum.
void add_state(py::module_& module);
/// Param, params().
void add_params(py::module_& module);
/// Camera, read_camera().
void add_camera(py::module_& module);
/// Frame.
void add_frame(py::module_& module);
/// Source, open_source(), simulate().
void add_source(py::module_& module);
/// Record.
void add_record(py::module_& module);
/// Event.
void add_event(py::module_& module);
/// Keyframe, Run, load_run().
void add_run(py::module_& module);
/// Odometry.
void add_odometry(py::module_& module);
/// run().
void add_run_function(py::module_& module);
/// Evaluation, evaluate().
void add_evaluation(py::module_& module);
/// Map.
void add_map(py::module_& module);

/// The member of State.
py::object to_python(TrackingState state);

}  // namespace edgevo::python
