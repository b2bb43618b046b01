// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// Ground truth of the data set folder or trajectory file at `path`. Throws InputError if there is none.
Trajectory source_truth(const std::string& path);

}  // namespace edgevo
