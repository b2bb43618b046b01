// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <memory>
#include <string>

#include "arguments.h"
#include "run_contents.h"

namespace edgevo::python {

/// A finished run as Python holds it.
struct PyRun {
  /// The run, not null; it never changes.
  std::shared_ptr<const RunContents> contents;
  /// The arrays that were made from it.
  std::map<std::string, py::object> arrays = {};
};

/// The argument as a run; throws TypeError.
const PyRun& run_argument(const Arguments& arguments, const char* argument);

}  // namespace edgevo::python
