// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Whether the vertices lie on a straight line in space: on a straight line in the image, with inverse depths
/// that are linear along it (as perspective preserves), within their standard deviations.
bool is_straight(const std::vector<EdgeVertex>& vertices);

}  // namespace edgevo
