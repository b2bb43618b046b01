#pragma once
// A flat piece of wall.
#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace edgevo {

/// Convex quadrilateral in the map's world, corners in order around it.
class WallPatch {
 public:
  using Corners = std::array<Eigen::Vector3d, 4>;
  explicit WallPatch(const Corners& corners);

  const Corners& corners() const { return corners_; }
  const Eigen::Vector3d& middle() const { return middle_; }  ///< mean of the corners
  double radius() const { return radius_; }                  ///< of the ball around middle() that holds it
  /// Of the corner that is farthest from the plane that fits them.
  double bend() const;
  /// Whether the way from one place to the other leads through it: from more than `thickness` before its
  /// plane to more than that behind.
  [[nodiscard]] bool is_crossed(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                double thickness) const;
  /// Calls `visit` for places on it, no farther than `step` from each other along its sides.
  template <class Visit>
  void sample(double step, const Visit& visit) const {
    const int along = steps({0, 1}, {3, 2}, step), across = steps({0, 3}, {1, 2}, step);
    for (int i = 0; i <= along; ++i)
      for (int j = 0; j <= across; ++j) {
        const double u = double(i) / along, v = double(j) / across;
        visit(Eigen::Vector3d((1 - v) * ((1 - u) * corners_[0] + u * corners_[1]) +
                              v * ((1 - u) * corners_[3] + u * corners_[2])));
      }
  }

 private:
  using Side = std::array<size_t, 2>;
  double length(const Side& side) const { return (corners_[side[0]] - corners_[side[1]]).norm(); }
  int steps(const Side& a, const Side& b, double step) const {
    return 1 + int(std::max(length(a), length(b)) / step);
  }
  bool holds(const Eigen::Vector3d& on_plane) const;

  Corners corners_;
  Eigen::Vector3d middle_, normal_;
  double radius_ = 0;
};

}  // namespace edgevo
