// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Brightness of some rows of the image of a camera at one pose.
#include <vector>

#include "edgevo/simulation/scene.h"
#include "lens_rays.h"
#include "scene_views.h"

namespace edgevo {

/// Adds the brightness, 0 to 255 and beyond, of these rows to `gray` (the whole image, row by row), seen
/// along the rays of the scene's camera; where it has none, nothing.
void add_rows_seen(const Scene& scene, const LensRays& rays, const Instant& at, RowRange rows,
                   std::vector<float>* gray);

/// Value of a pixel where no body is seen.
constexpr uint8_t kSceneAlone = 255;
/// Sets these rows of `bodies` (the whole image, row by row): the number of the first body that one of the
/// pixel's samples meets, 99 at most, or kSceneAlone.
void set_rows_of_bodies(const Scene& scene, const LensRays& rays, const Instant& at, RowRange rows,
                        std::vector<uint8_t>* bodies);

}  // namespace edgevo
