#pragma once
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Whether the vertices lie on one line of space: on one of the image, with inverse depths that are linear
/// along it (which a perspective image keeps), within their deviations.
bool is_straight(const std::vector<EdgeVertex>& vertices);

}  // namespace edgevo
