// SPDX-License-Identifier: BSD-3-Clause
// The extension module edgevo._edgevo. The package edgevo passes on what it holds.
#include "classes.h"

PYBIND11_MODULE(_edgevo, m) {
  using namespace edgevo::python;
  m.doc() = "Monocular edge visual odometry: arrays in, arrays out.";
  m.attr("__version__") = EDGEVO_VERSION;
  py::options options;
  options.disable_function_signatures();
  add_errors(m);
  add_state(m);
  add_params(m);
  add_camera(m);
  add_frame(m);
  add_source(m);
  add_record(m);
  add_event(m);
  add_run(m);
  add_odometry(m);
  add_run_function(m);
  add_evaluation(m);
  add_map(m);
}
