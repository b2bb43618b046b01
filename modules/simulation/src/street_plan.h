// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Straight streets or corridors with two sides, along which a builder places objects.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "scene_params.h"
#include "world_builder.h"

namespace edgevo {

/// A street of `length` metres from `start` on.
struct Street {
  /// Start, metres, and direction, a unit vector.
  Eigen::Vector2d start, along;
  double length;
  /// Distance of `p` to the middle line.
  double distance(const Eigen::Vector2d& p) const {
    const double s = std::clamp((p - start).dot(along), 0.0, length);
    return (p - start - s * along).norm();
  }
};

/// One side of a street: s runs along it, d away from its middle.
struct Side {
  const Street* street;
  /// +1: left of the direction of the waypoints; -1: right.
  double sign;
  Eigen::Vector2d at(double s, double d) const {
    return street->start + s * street->along +
           sign * d * Eigen::Vector2d(-street->along.y(), street->along.x());
  }
  /// Frame facing the street, with the origin at (s, d).
  LocalFrame place(double s, double d, double z = 0) const {
    const Eigen::Vector2d p = at(s, d), out = at(s, d - 1) - p;
    return facing({p.x(), p.y(), z}, std::atan2(out.y(), out.x()));
  }
  /// As place(), for an object from s to s + width: the origin is its left end as seen from the street.
  LocalFrame left_end(double s, double width, double d, double z = 0) const {
    return place(sign > 0 ? s : s + width, d, z);
  }
};

/// One street for each leg, longer by `before` and `beyond` metres; the first one by `first` at its start.
inline std::vector<Street> streets_of(const std::vector<Leg>& legs, double first, double before,
                                      double beyond) {
  std::vector<Street> streets;
  for (const Leg& leg : legs) {
    const Eigen::Vector2d along = (leg.to - leg.from).normalized();
    const double ahead = streets.empty() ? first : before;
    streets.push_back({leg.from - ahead * along, along, (leg.to - leg.from).norm() + ahead + beyond});
  }
  return streets;
}

/// The same for the legs between waypoints.
inline std::vector<Street> streets_of(const std::vector<Eigen::Vector3d>& waypoints, double first,
                                      double before, double beyond) {
  return streets_of(legs_between(waypoints), first, before, beyond);
}

/// Distance of p to the nearest middle line of a street other than `own`.
inline double room(const std::vector<Street>& streets, const Street& own, const Eigen::Vector2d& p) {
  double nearest = 1e9;
  for (const Street& s : streets)
    if (&s != &own) nearest = std::min(nearest, s.distance(p));
  return nearest;
}

}  // namespace edgevo
