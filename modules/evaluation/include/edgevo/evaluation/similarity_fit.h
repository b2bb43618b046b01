// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Best similarity or rigid motion between two lists of points (Umeyama 1991), as in evo:
// minimise sum_i || dst_i - (s R src_i + t) ||^2 over s, R, t (Sim(3)), or with s = 1 (SE(3)).
//
// For points on one line the rotation about the line is undetermined: any choice has the same residual, and
// scale and residual are still well defined. For points that all coincide the result is nullopt.
#include <Eigen/Core>
#include <optional>

#include "edgevo/core/sim3.h"

namespace edgevo {

/// Points as columns.
using Points = Eigen::Matrix3Xd;

/// Root mean square distance of the points from their mean; 0 without points.
double spread(const Points& points);

/// Whether all points coincide, to 1e-9 of their distance from the origin. `points` must not be empty.
bool coincide(const Points& points);

/// Least-squares Sim(3) with dst ~ s R src + t; nullopt for fewer than 3 points, for a list whose points
/// coincide, or if no positive scale fits. Cost: linear.
std::optional<Sim3> fit_sim3(const Points& src, const Points& dst);

/// Least-squares SE(3) with dst ~ R src + t; nullopt for fewer than 3 points.
std::optional<Sim3> fit_se3(const Points& src, const Points& dst);

}  // namespace edgevo
