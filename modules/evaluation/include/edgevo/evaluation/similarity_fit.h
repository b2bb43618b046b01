#pragma once
// The best similarity or rigid motion between two lists of points (Umeyama 1991), as evo uses it:
// minimise sum_i || dst_i - (s R src_i + t) ||^2 over s, R, t (Sim(3)), or with s = 1 (SE(3)).
//
// Points on one line leave the rotation about that line open: any choice has the same residual, and scale and
// residual stay well defined. Points that all coincide define nothing: the result is nullopt.
#include <Eigen/Core>
#include <optional>

#include "edgevo/core/se3.h"

namespace edgevo {

using Points = Eigen::Matrix3Xd;  ///< one point a column

/// Root mean square distance of the points from their mean; 0 for none.
double spread(const Points& points);

/// They are all in one place, to 1e-9 of their distance from the origin. At least one point.
bool coincide(const Points& points);

/// Sim(3) with dst ~ s R src + t. nullopt for fewer than 3 points, for a list whose points coincide, or if no
/// positive scale fits. Cost: linear.
std::optional<Sim3> fit_sim3(const Points& src, const Points& dst);

/// SE(3) with dst ~ R src + t; nullopt for fewer than 3 points.
std::optional<Sim3> fit_se3(const Points& src, const Points& dst);

}  // namespace edgevo
