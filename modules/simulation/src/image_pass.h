// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Brightness of some rows of the image of a camera at one pose.
#include <vector>

#include "edgevo/simulation/scene.h"
#include "view.h"

namespace edgevo {

/// Adds the brightness, 0 to 255 and beyond, of these rows to `gray` (the whole image, row by row). `rays`
/// holds the ray (x, y) of each sample point through a distorting lens, row by row, sample by sample; it is
/// empty for a pinhole.
void add_rows_seen(const Scene& scene, const std::vector<Eigen::Vector2f>& rays, const SE3& T_scene_cam,
                   RowRange rows, std::vector<float>* gray);

}  // namespace edgevo
