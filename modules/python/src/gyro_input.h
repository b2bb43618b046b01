// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Samples of a gyro from Python.
#include <pybind11/pybind11.h>

#include <string>

#include "edgevo/core/gyro_sample.h"

namespace edgevo::python {

namespace py = pybind11;

/// A sample of a time and three rates; `time_where` and `rate_where` open the messages. Throws TypeError or
/// InputError.
GyroSample gyro_sample(py::handle time, const std::string& time_where, py::handle rate,
                       const std::string& rate_where);

/// Those of an iterable of (time, rate), such as the attribute `gyro` of a source of the user.
GyroReadings gyro_samples(py::handle pairs, const std::string& where);

}  // namespace edgevo::python
