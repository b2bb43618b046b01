// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a point of one keyframe lies in another.
#include "edgevo/alignment/projection.h"

namespace edgevo {

/// Least distance in pixels between a point and the border of the image: its patch still lies inside, and a
/// match may move by as much.
constexpr double kViewBorderPx = 6;

/// Whether a point of the host, given by pixel and inverse depth, lies in the target's image; `px` is where.
inline bool in_view(const Pinhole& camera, const SE3& T_target_host, const Eigen::Vector2d& px_host,
                    double idepth, Eigen::Vector2d* px) {
  const Projection p =
      project(camera, T_target_host.R(), T_target_host.translation(), camera.ray(px_host), idepth);
  if (!p.valid || !camera.contains(p.px, kViewBorderPx)) return false;
  *px = p.px;
  return true;
}

}  // namespace edgevo
