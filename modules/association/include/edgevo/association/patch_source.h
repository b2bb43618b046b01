// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Selects the host level from which the patch of a point is cut: the one whose pixels are closest in size to
// those of the target.
#include <Eigen/Core>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Host level with the point and its warp in pixels of that level.
struct PatchSource {
  /// Selected level of the host.
  const PyramidLevel* level = nullptr;
  /// Position of the point, pixels of that level.
  Eigen::Vector2d px;
  /// Warp d p_target / d p_host, with p_host in pixels of that level.
  Eigen::Matrix2d A_target_host;
};

/// Selects the finest level, unless the target sees the patch at less than 0.6 of its size (a camera that
/// backs away): sampled so sparsely, the finest image shows detail that the pixels of the target average out.
/// Levels without gradients are not used.
PatchSource patch_source(const FramePyramid& host, const Eigen::Vector2d& px_host,
                         const Eigen::Matrix2d& A_target_host);

}  // namespace edgevo
