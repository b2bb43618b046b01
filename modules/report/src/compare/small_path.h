// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A path from above as a picture of 110 x 70 pixels, on top of the true path: shape only, no axes.
#include <string>

#include "run_figures.h"

namespace edgevo {

/// Every n-th point and the last one, at most `most` + 1 points.
GroundPath thinned(const GroundPath& path, size_t most);

/// The picture as an svg element; empty for an empty path.
std::string small_path_svg(const GroundPath& path, const GroundPath& truth);

}  // namespace edgevo
