#pragma once
// How well an alignment knows its pose: the covariance of xi in T_cur_ref <- exp(xi) T_cur_ref, tangent [v,
// w], unit of the map and radians.
//
// Paper, Eq. (poseuncertainty) with the inverse that its print lacks: Sigma = A^-1 sigma_r^2, A = sum w J^T
// J. That takes residuals as independent. Points on one edge share the error of that edge, so the sum of
// their scores g = w r J^T varies more than their number says. The sandwich estimator measures by how much,
// with the edges as clusters:
//
//   Sigma = A^-1 M A^-1,   M = n/(n - 6) sum_e (sum_{p in e} g_p) (sum_{p in e} g_p)^T   over n edges e,
//
// in every direction at least A^-1 sigma_r^2, so that a direction that no edge fixes is not taken for
// certain. What no residual shows is the reference's own error: its cloud was placed by an alignment of the
// same kind. kReferenceShare, one number for all scenes, adds it.
//
// What it is the covariance of: the pose against the reference keyframe in the unit of length of the map
// there. The scale of a monocular map wanders by some 0.2 to 1 % along the way, which is not in it: whoever
// fuses poses with metric sensors must estimate the scale, or add (0.01 T_cur_ref.t)(0.01 T_cur_ref.t)^T.
// Held against the truth of rendered scenes by tests/regression.
#include <vector>

#include "edgevo/core/se3.h"

namespace edgevo {

/// A matched point in the normal equations.
struct PoseEquation {
  Eigen::Matrix<double, 1, 6> jacobian;  ///< of the residual by xi, tangent [v, w]
  double residual_px = 0;  ///< along the edge normal
  double weight = 0;  ///< robust weight times that of the depth
  int edge = 0;       ///< points of one edge carry the same number, >= 0
};

/// Variance with the reference's own error over that of the alignment alone: measured 1.41 to 1.69 on four
/// rendered scenes. Where a map is worse or better than that is found while running:
/// odometry/tracking_check.h.
constexpr double kReferenceShare = 1.5;

/// The above. Without equations, a covariance of 1e9 times kMinResidualVariance. Cost: 0.05 ms for 1500
/// equations.
Matrix6d pose_covariance(const std::vector<PoseEquation>& equations);

/// Square of the error xi = log(T_estimate T_true^-1), normalised by its covariance, without its part along the
/// translation, which a wrong unit of length makes: it is taken out with the covariance as metric. Follows
/// chi^2 with kNormalisedErrorFreedom degrees of freedom where the covariance is right.
double normalised_error_square(const SE3& T_estimate, const SE3& T_true, const Matrix6d& covariance);
constexpr int kNormalisedErrorFreedom = 5;  ///< six of a pose, less the length

}  // namespace edgevo
