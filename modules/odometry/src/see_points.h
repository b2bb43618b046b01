#pragma once
// The points of a reference cloud as another frame sees them.
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/odometry/frame_view.h"

namespace edgevo {

/// Those that lie in front of the camera and inside the image. `idepth_factor` takes inverse depths from the
/// map's unit to the world's.
std::vector<SeenPoint> see_points(const ReferenceCloud& cloud, const SE3& T_cur_ref,
                                  const FramePyramid& current, double idepth_factor);

}  // namespace edgevo
