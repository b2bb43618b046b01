// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The line on which a point of one image must lie in another.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/mapping/epipolar_search.h"

namespace edgevo {

/// The epipolar segment of a range of inverse depths, in target pixels.
struct EpipolarSegment {
  bool visible = false;
  /// Start point, and unit direction from low to high inverse depth.
  Eigen::Vector2d start, direction;
  double length = 0;
};

/// Epipolar segment of a host ray x: `rotated_ray` is R x, `t` the translation. Covers points in front of the
/// target only.
EpipolarSegment epipolar_segment(const Pinhole& camera, const Eigen::Vector3d& rotated_ray,
                                 const Eigen::Vector3d& t, const IdepthRange& range);

/// Clips the segment to the image without a border of `border` pixels; false if nothing is left.
bool clip(const Pinhole& camera, double border, EpipolarSegment* s);

}  // namespace edgevo
