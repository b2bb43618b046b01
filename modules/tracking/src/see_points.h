// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The points of a reference cloud as another frame sees them.
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/tracking/frame_view.h"

namespace edgevo {

/// The points in front of the camera and inside the image. `idepth_factor` converts inverse depths from the
/// map's unit to the world's.
std::vector<SeenPoint> see_points(const ReferenceCloud& cloud, const SE3& T_cur_ref,
                                  const FramePyramid& current, double idepth_factor);

}  // namespace edgevo
