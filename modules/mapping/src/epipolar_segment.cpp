// SPDX-License-Identifier: BSD-3-Clause
#include "epipolar_segment.h"

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"

namespace edgevo {
namespace {

// Least depth in the target over that in the host; nearer points fill the image and are not searched.
constexpr double kMinZ = 0.1;
// Pixels, or a component of a unit vector: anything shorter is rounding and has no direction.
constexpr double kShort = 1e-9;

}  // namespace

EpipolarSegment epipolar_segment(const Pinhole& camera, const Eigen::Vector3d& rotated_ray,
                                 const Eigen::Vector3d& t, const IdepthRange& range) {
  EpipolarSegment s;
  double high = range.high;
  // If the camera moves towards the point, larger inverse depths would lie behind it.
  if (rotated_ray.z() + high * t.z() < kMinZ) {
    if (!(t.z() < 0)) return s;
    high = (kMinZ - rotated_ray.z()) / t.z();
    if (!(high > range.low)) return s;
  }
  const Eigen::Vector3d near_low = rotated_ray + range.low * t, near_high = rotated_ray + high * t;
  if (!(near_low.z() > kMinProjectedDepth)) return s;
  s.start = camera.project(near_low);
  const Eigen::Vector2d span = camera.project(near_high) - s.start;
  s.length = span.norm();
  s.direction = s.length > kShort ? Eigen::Vector2d(span / s.length) : Eigen::Vector2d::UnitX();
  s.visible = true;
  return s;
}

bool clip(const Pinhole& camera, double border, EpipolarSegment* s) {
  double from = 0, to = s->length;
  const double high[2] = {camera.width - 1 - border, camera.height - 1 - border};
  for (int axis = 0; axis < 2; ++axis) {
    const double p = s->start[axis], d = s->direction[axis];
    if (std::abs(d) < kShort) {
      if (p < border || p > high[axis]) return false;
      continue;
    }
    double a = (border - p) / d, b = (high[axis] - p) / d;
    if (a > b) std::swap(a, b);
    from = std::max(from, a);
    to = std::min(to, b);
  }
  if (from > to) return false;
  s->start += from * s->direction;
  s->length = to - from;
  return true;
}

}  // namespace edgevo
