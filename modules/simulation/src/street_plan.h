#pragma once
// Straight ways with two sides, along which a builder puts things: streets, corridors.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "world_builder.h"

namespace edgevo {

/// A way of `length` metres from `start` on.
struct Street {
  Eigen::Vector2d start, along;  // `along` is a unit vector
  double length;
  double distance(const Eigen::Vector2d& p) const {  // to the middle line
    const double s = std::clamp((p - start).dot(along), 0.0, length);
    return (p - start - s * along).norm();
  }
};

/// One side of a street: s runs along it, d away from its middle.
struct Side {
  const Street* street;
  double sign;  // +1: left of the direction of the way points
  Eigen::Vector2d at(double s, double d) const {
    return street->start + s * street->along +
           sign * d * Eigen::Vector2d(-street->along.y(), street->along.x());
  }
  /// Facing the street, with the origin at (s, d).
  Place place(double s, double d, double z = 0) const {
    const Eigen::Vector2d p = at(s, d), out = at(s, d - 1) - p;
    return facing({p.x(), p.y(), z}, std::atan2(out.y(), out.x()));
  }
  /// As place(), for something from s to s + width: seen from the street its left end is the origin.
  Place left_end(double s, double width, double d, double z = 0) const {
    return place(sign > 0 ? s : s + width, d, z);
  }
};

/// One way for each leg between way points, longer by `before` and `beyond` metres; the first one by `first`
/// at its start.
inline std::vector<Street> streets_of(const std::vector<Eigen::Vector3d>& way_points, double first,
                                      double before, double beyond) {
  std::vector<Street> streets;
  for (size_t i = 0; i + 1 < way_points.size(); ++i) {
    const Eigen::Vector2d a = way_points[i].head<2>(), b = way_points[i + 1].head<2>(),
                          along = (b - a).normalized();
    const double ahead = i == 0 ? first : before;
    streets.push_back({a - ahead * along, along, (b - a).norm() + ahead + beyond});
  }
  return streets;
}

/// Distance of p to the nearest middle line of another street than `own`.
inline double room(const std::vector<Street>& streets, const Street& own, const Eigen::Vector2d& p) {
  double nearest = 1e9;
  for (const Street& s : streets)
    if (&s != &own) nearest = std::min(nearest, s.distance(p));
  return nearest;
}

}  // namespace edgevo
