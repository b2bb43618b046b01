#pragma once
// Where the patch of a point is cut: from the host level whose pixels are nearest in size to the target's.
#include <Eigen/Core>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// A level of the host, the point and its warp in that level's pixels.
struct PatchSource {
  const PyramidLevel* level = nullptr;  ///< of the host
  Eigen::Vector2d px;  ///< the point, in pixels of that level
  Eigen::Matrix2d A_target_host;  ///< d p_target / d p_host, p_host in pixels of that level
};

/// The finest level, unless the target sees the patch at less than 0.6 of its size (a camera that backs away): sampled so sparsely the
/// finest image shows detail that the target's pixels average out. Levels without gradients are not taken.
PatchSource patch_source(const FramePyramid& host, const Eigen::Vector2d& px_host, const Eigen::Matrix2d& A_target_host);

}  // namespace edgevo
