// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/report/run_info.h"

namespace edgevo {

/// What was found to be fixed to the camera, as a picture of the mask; empty if there is no such part.
std::string mask_section(const RunInfo& info);

}  // namespace edgevo
