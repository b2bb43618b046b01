#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "edgevo/core/se3.h"

namespace edgevo {

/// Length of a line's normal, on the image plane z = 1 and for a baseline of 1, below which it has no
/// direction: a point in the epipole. Keeps a division finite; a pixel from the epipole it is a thousandth.
constexpr double kLeastLineLength = 1e-12;

/// The epipolar lines of two rays x and y, (x, y, 1), of one point: where each view expects what the other
/// one sees.
struct EpipolarLines {
  Eigen::Vector3d in_to;  ///< l = t x R x; the point is on it where l^T y = 0
  /// |(l_1, l_2, l'_1, l'_2)| with l' = R^T (y x t) in the first view; l^T y over it is Sampson's distance on
  /// z = 1.
  double length = 0;
};
/// `x` in the first view ("from"), `y` in the second ("to"), both (x, y, 1). The lines do not depend on the
/// length of the translation; `length` does.
inline EpipolarLines epipolar_lines(const SE3& T_to_from, const Eigen::Vector3d& x,
                                    const Eigen::Vector3d& y) {
  const Eigen::Vector3d t = T_to_from.translation(), in_to = t.cross(T_to_from.rotation() * x);
  const Eigen::Vector3d in_from = T_to_from.rotation().inverse() * y.cross(t);
  return {in_to, std::max(std::hypot(in_to.head<2>().norm(), in_from.head<2>().norm()), kLeastLineLength)};
}

}  // namespace edgevo
