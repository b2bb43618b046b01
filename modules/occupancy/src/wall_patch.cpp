#include "wall_patch.h"

#include <Eigen/Geometry>
#include <cmath>

namespace edgevo {

WallPatch::WallPatch(const Corners& corners)
    : corners_(corners),
      middle_(0.25 * (corners[0] + corners[1] + corners[2] + corners[3])),
      normal_((corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized()) {
  for (const Eigen::Vector3d& c : corners_) radius_ = std::max(radius_, (c - middle_).norm());
}

// Both diagonals are parallel to the plane, one as far before it as the other is behind.
double WallPatch::bend() const { return 0.5 * std::abs(normal_.dot(corners_[1] - corners_[0])); }

bool WallPatch::holds(const Eigen::Vector3d& on_plane) const {
  for (size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector3d side = corners_[(i + 1) % corners_.size()] - corners_[i];
    if (normal_.dot(side.cross(on_plane - corners_[i])) < 0) return false;
  }
  return true;
}

bool WallPatch::is_crossed(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double thickness) const {
  const double before = normal_.dot(from - middle_), behind = normal_.dot(to - middle_);
  if (before * behind >= 0 || std::min(std::abs(before), std::abs(behind)) <= thickness) return false;
  return holds(from + (to - from) * before / (before - behind));
}

}  // namespace edgevo
