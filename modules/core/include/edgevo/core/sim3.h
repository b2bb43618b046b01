// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Similarities Sim(3).
//
// T_a_b maps coordinates from b to a:            p_a = T_a_b p_b = s R p_b + t
// Tangent of sim(3): xi = [v, w, sigma], translation first, logarithm of the scale last; exp is the TRUE
// exponential, of the matrix [ sigma I + [w]x, v; 0, 0 ]. With sigma = 0 all of it is as in se3.h.
// Perturbations are from the left unless said otherwise: T <- exp(xi) T.
#include "edgevo/core/se3.h"

namespace edgevo {

/// Tangent vector [v, w, sigma] of a similarity.
using Vector7d = Eigen::Matrix<double, 7, 1>;
/// Covariance or information matrix of a tangent vector of a similarity.
using Matrix7d = Eigen::Matrix<double, 7, 7>;

/// Similarity p_a = s R p_b + t, the gauge freedom of a monocular map. scale > 0.
struct Sim3 {
  /// Scale s > 0.
  double scale = 1.0;
  /// Rotation R and translation t.
  SE3 rigid;

  /// True exponential of xi = [v, w, sigma] (map units, radians, logarithm of the scale).
  static Sim3 exp(const Vector7d& xi);
  /// Inverse of exp(); |w| <= pi.
  Vector7d log() const;

  /// Transformed point s R p + t.
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const {
    return scale * (rigid.rotation() * p) + rigid.translation();
  }
  /// Composition: first `other`, then this.
  Sim3 operator*(const Sim3& other) const;
  /// Inverse similarity.
  Sim3 inverse() const;
  /// Adjoint Ad(T): exp(Ad(T) xi) = T exp(xi) T^-1.
  Matrix7d adjoint() const;
  /// Pose in frame a of a camera at T_b_cam, without the scale in its rotation.
  SE3 apply(const SE3& T_b_cam) const;
};

/// Adjoint of the algebra: ad(a) b = [a, b]; exp of it is Ad(exp(a)).
Matrix7d sim3_ad(const Vector7d& xi);

/// Left Jacobian of Sim(3): exp(xi + d) = exp(J d) exp(xi) to first order in d. The right one is that of -xi.
Matrix7d sim3_left_jacobian(const Vector7d& xi);
/// Its inverse: log(exp(d) exp(xi)) = xi + J^-1 d to first order in d.
Matrix7d sim3_left_jacobian_inverse(const Vector7d& xi);

}  // namespace edgevo
