// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Brightness of some rows of the image of a camera at one pose.
#include <vector>

#include "edgevo/simulation/scene.h"
#include "lens_rays.h"
#include "view.h"

namespace edgevo {

/// Adds the brightness, 0 to 255 and beyond, of these rows to `gray` (the whole image, row by row), seen
/// along the rays of the scene's camera; where it has none, nothing.
void add_rows_seen(const Scene& scene, const LensRays& rays, const SE3& T_scene_cam, RowRange rows,
                   std::vector<float>* gray);

}  // namespace edgevo
