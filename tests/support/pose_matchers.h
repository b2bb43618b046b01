// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Matchers for poses and Jacobians whose failure messages show the size and position of the error:
//
//   EXPECT_THAT(T_cur_ref, SE3Near(truth, 0.01, 0.001));
//   EXPECT_THAT(jacobian, JacobianNear(numerical_jacobian<6>(residual), 1e-6));
#include <gmock/gmock.h>

#include <Eigen/Core>
#include <ostream>
#include <type_traits>

#include "edgevo/core/se3.h"

namespace edgevo {

/// Prints a pose in failure messages.
inline void PrintTo(const SE3& T, std::ostream* out) {
  const Eigen::Quaterniond& q = T.rotation();
  *out << "translation (" << T.translation().transpose() << "), quaternion xyzw (" << q.coeffs().transpose()
       << ")";
}

namespace test {

/// Matches an SE3 that differs from `expected` by at most `tolerance_m` in its translation and at most
/// `tolerance_rad` in its rotation.
MATCHER_P3(SE3Near, expected, tolerance_m, tolerance_rad,
           (negation ? "is not within " : "is within ") + ::testing::PrintToString(tolerance_m) + " and " +
               ::testing::PrintToString(tolerance_rad) + " rad of " + ::testing::PrintToString(expected)) {
  const double off_m = (arg.translation() - expected.translation()).norm();
  const double off_rad = (arg * expected.inverse()).angle();
  *result_listener << "which is off by " << off_m << " (" << tolerance_m << " allowed) and " << off_rad
                   << " rad (" << tolerance_rad << " allowed)";
  return off_m <= tolerance_m && off_rad <= tolerance_rad;
}

/// Matches a matrix each column of which differs from that of `numeric` by at most `tolerance` (1 + norm of
/// the column).
MATCHER_P2(JacobianNear, numeric, tolerance,
           (negation ? "is not within " : "is within ") + ::testing::PrintToString(tolerance) +
               " of the numeric derivative") {
  if (arg.rows() != numeric.rows() || arg.cols() != numeric.cols()) {
    *result_listener << "which is " << arg.rows() << " x " << arg.cols() << ", not " << numeric.rows()
                     << " x " << numeric.cols();
    return false;
  }
  for (Eigen::Index k = 0; k < numeric.cols(); ++k) {
    const double off = (arg.col(k) - numeric.col(k)).norm(),
                 allowed = tolerance * (1 + numeric.col(k).norm());
    if (off <= allowed) continue;
    *result_listener << "whose column " << k << " is off by " << off << " (" << allowed << " allowed): ("
                     << arg.col(k).transpose() << "), numerically (" << numeric.col(k).transpose() << ")";
    return false;
  }
  return true;
}

}  // namespace test
}  // namespace edgevo
