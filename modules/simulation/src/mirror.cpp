// SPDX-License-Identifier: BSD-3-Clause
#include "mirror.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

class Mirror {
 public:
  explicit Mirror(const UprightPlane& plane)
      : point_(plane.point.x(), plane.point.y(), 0), normal_(plane.normal.x(), plane.normal.y(), 0) {}

  // Distance of a surface's nearest and farthest corner beyond the plane, metres.
  double nearest(const Surface& s) const {
    return beyond(s.origin) + std::min(0.0, normal_.dot(s.side_u)) + std::min(0.0, normal_.dot(s.side_v));
  }
  double farthest(const Surface& s) const {
    return beyond(s.origin) + std::max(0.0, normal_.dot(s.side_u)) + std::max(0.0, normal_.dot(s.side_v));
  }

  // Ends a surface at the plane, if its sides allow.
  void cut(Surface* s) const {
    if (farthest(*s) <= 0 || s->is_triangle) return;
    if (is_along(s->side_u) && is_in_plane(s->side_v)) cut_side(0, &s->side_u, s);
    if (is_along(s->side_v) && is_in_plane(s->side_u)) cut_side(1, &s->side_v, s);
  }

  Surface image(Surface s) const {
    s.origin -= 2 * beyond(s.origin) * normal_;
    s.side_u -= 2 * normal_.dot(s.side_u) * normal_;
    s.side_v -= 2 * normal_.dot(s.side_v) * normal_;
    if (s.is_triangle) return s;  // seen from both sides
    // A mirror image is seen from behind: side_u, and u with it, is turned round.
    s.origin += s.side_u;
    s.side_u = -s.side_u;
    s.uv_origin.x() += s.uv_size.x();
    s.uv_size.x() = -s.uv_size.x();
    return s;
  }

 private:
  double beyond(const Eigen::Vector3d& p) const { return normal_.dot(p - point_); }
  bool is_along(const Eigen::Vector3d& side) const {
    return std::abs(std::abs(normal_.dot(side)) - side.norm()) < 1e-9;
  }
  bool is_in_plane(const Eigen::Vector3d& side) const { return std::abs(normal_.dot(side)) < 1e-9; }

  // Keeps the part of `side` (0: u, 1: v) before the plane.
  void cut_side(int axis, Eigen::Vector3d* side, Surface* s) const {
    const double begin = beyond(s->origin), end = begin + normal_.dot(*side);
    const double at = begin / (begin - end);  // share of the side at which the plane is
    if (begin > 0) {
      s->origin += at * *side;
      s->uv_origin[axis] += at * s->uv_size[axis];
    }
    const double kept = begin > 0 ? 1 - at : at;
    *side *= kept;
    s->uv_size[axis] *= kept;
  }

  const Eigen::Vector3d point_, normal_;
};

}  // namespace

void add_mirror_image(const UprightPlane& plane, std::vector<Surface>* surfaces) {
  const Mirror mirror(plane);
  surfaces->erase(std::remove_if(surfaces->begin(), surfaces->end(),
                                 [&](const Surface& s) { return mirror.nearest(s) > -1e-6; }),
                  surfaces->end());
  const size_t count = surfaces->size();
  surfaces->reserve(2 * count);
  for (size_t i = 0; i < count; ++i) {
    mirror.cut(&(*surfaces)[i]);
    surfaces->push_back(mirror.image((*surfaces)[i]));
  }
}

}  // namespace edgevo
