// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "arguments.h"
#include "edgevo/results/run_params.h"

namespace edgevo::python {

/// The parameters of a run from a dict, whose keys are dotted ("edges.detector") or groups that are dicts
/// again. Those that are not named keep their defaults. Throws TypeError or InputError.
RunParams run_params(const Arguments& arguments, const char* argument);

}  // namespace edgevo::python
