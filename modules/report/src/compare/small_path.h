#pragma once
// A path from above as a picture of 110 x 70 pixels, with the true one under it: shape only, no axes.
#include <string>

#include "run_figures.h"

namespace edgevo {

/// Every n-th of the points, and the last, at most `most` and one.
GroundPath thinned(const GroundPath& path, size_t most);

std::string small_path_svg(const GroundPath& path, const GroundPath& truth);

}  // namespace edgevo
