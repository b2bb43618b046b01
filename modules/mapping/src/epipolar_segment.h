#pragma once
// The line on which a point of one image must lie in another.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/mapping/epipolar_search.h"

namespace edgevo {

/// The epipolar segment of a range of inverse depths, in target pixels.
struct EpipolarSegment {
  bool visible = false;
  Eigen::Vector2d start, direction;  ///< direction is a unit vector from low to high inverse depth
  double length = 0;
};

/// `rotated_ray` is R x for the host's ray x, `t` the translation; of points in front of the target only.
EpipolarSegment epipolar_segment(const Pinhole& camera, const Eigen::Vector3d& rotated_ray,
                                 const Eigen::Vector3d& t, const IdepthRange& range);

/// Cuts the segment to what lies inside the image, `border` pixels away from its edge; false if nothing does.
bool clip(const Pinhole& camera, double border, EpipolarSegment* s);

}  // namespace edgevo
