// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Rigid motions SE(3). Similarities: sim3.h.
//
// T_a_b maps coordinates from b to a:            p_a = T_a_b p_b = R p_b + t
// Tangent of se(3): xi = [v, w], translation part first; exp is the TRUE exponential (the translation is V(w)
// v, not v). Perturbations are always from the left: T <- exp(xi) T, so that for p_a =
// T_a_b p_b
//     d p_a / d xi = [ I | -[p_a]x ]            (3x6)
// MRPT's Lie::SE<3>::exp leaves the translation untouched: never mix the two.
// Rotations are unit quaternions and are normalised in every product, so that long chains stay rotations.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace edgevo {

/// Tangent vector [v, w], translation first.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// Covariance or information matrix of a tangent vector.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Cross-product matrix: skew(a) b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Rigid motion p_a = R p_b + t. A value of 64 bytes, cheap to copy.
class SE3 {
 public:
  SE3() = default;
  /// From a quaternion, which need not be normalised but must not be zero, and a translation.
  SE3(const Eigen::Quaterniond& q, const Eigen::Vector3d& t) : q_(q.normalized()), t_(t) {}
  /// From a rotation matrix and a translation.
  SE3(const Eigen::Matrix3d& R, const Eigen::Vector3d& t) : q_(Eigen::Quaterniond(R).normalized()), t_(t) {}

  /// From a unit quaternion, which is kept to the last bit, e.g. one that was written to a file, and a
  /// translation.
  static SE3 from_unit(const Eigen::Quaterniond& q, const Eigen::Vector3d& t) {
    SE3 T;
    T.q_ = q, T.t_ = t;
    return T;
  }

  /// True exponential of xi = [v, w] (metres or map units, radians).
  static SE3 exp(const Vector6d& xi);
  /// Inverse of exp(); |w| <= pi.
  Vector6d log() const;

  /// Inverse transform: T_b_a of T_a_b.
  SE3 inverse() const;
  /// Composition T_a_c = T_a_b T_b_c.
  SE3 operator*(const SE3& other) const { return {q_ * other.q_, q_ * other.t_ + t_}; }
  /// Transformed point p_a = T_a_b p_b.
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return q_ * p + t_; }

  /// Adjoint Ad(T): exp(Ad(T) xi) = T exp(xi) T^-1, for tangents [v, w].
  Matrix6d adjoint() const;

  /// Rotation as a unit quaternion.
  const Eigen::Quaterniond& rotation() const { return q_; }
  /// Rotation matrix.
  Eigen::Matrix3d R() const { return q_.toRotationMatrix(); }
  /// Translation vector t.
  const Eigen::Vector3d& translation() const { return t_; }
  /// Homogeneous matrix [R t; 0 1].
  Eigen::Matrix4d matrix() const;
  /// Rotation angle in [0, pi], radians.
  double angle() const;
  /// Whether no value is NaN or infinite.
  bool is_finite() const { return q_.coeffs().allFinite() && t_.allFinite(); }

 private:
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d t_ = Eigen::Vector3d::Zero();
};

}  // namespace edgevo
