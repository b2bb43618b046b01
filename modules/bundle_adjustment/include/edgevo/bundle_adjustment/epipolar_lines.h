// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "edgevo/core/se3.h"

namespace edgevo {

/// Length of a line's normal, on the image plane z = 1 and for a baseline of 1, below which it has no
/// direction (a point at the epipole). Keeps a division finite; at a pixel from the epipole the length is
/// about 1e-3.
constexpr double kMinLineLength = 1e-12;

/// Epipolar lines of two viewing rays x and y, each (x, y, 1), of one point.
struct EpipolarLines {
  /// Line l = t x R x in the second view; y is on it if l^T y = 0.
  Eigen::Vector3d in_to;
  /// Length |(l_1, l_2, l'_1, l'_2)| with l' = R^T (y x t) in the first view; l^T y over it is Sampson's
  /// distance on z = 1.
  double length = 0;
};
/// Epipolar lines of `x` in the first view ("from") and `y` in the second ("to"), both (x, y, 1). The lines
/// do not depend on the length of the translation; `length` does.
inline EpipolarLines epipolar_lines(const SE3& T_to_from, const Eigen::Vector3d& x,
                                    const Eigen::Vector3d& y) {
  const Eigen::Vector3d t = T_to_from.translation(), in_to = t.cross(T_to_from.rotation() * x);
  const Eigen::Vector3d in_from = T_to_from.rotation().inverse() * y.cross(t);
  return {in_to, std::max(std::hypot(in_to.head<2>().norm(), in_from.head<2>().norm()), kMinLineLength)};
}

}  // namespace edgevo
