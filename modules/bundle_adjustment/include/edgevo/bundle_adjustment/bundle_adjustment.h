// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Local bundle adjustment over a window of keyframes: poses and inverse depths of hosted points.
// Source: paper, Eq. (reprojectionerror).
//
// A point is stored in its host keyframe h as viewing ray x = (x, y, 1) and inverse depth rho. In keyframe t:
//     Y = R x + rho t,   T_t_h = T_t_world T_h_world^-1 = (R, t),   p' = pi(Y)    (Y: the point times rho)
// Its match in t is an edge pixel m with unit normal n (image gradient) and edge direction
// n_perp = (-n_y, n_x). The residual is taken in the edge's own axes and whitened:
//     r_n = n^T (p' - m) / sigma_n          always (point to tangent, Eq. (edgeerror))
//     r_t = n_perp^T (p' - m) / sigma_t     photometric matches only; omitted if a match is ambiguous
// and Huber's loss is applied to the norm of (r_n, r_t) by iteratively re-weighted least squares.
//
// Derivatives, for the left perturbation T_cam_world <- exp(xi) T_cam_world:
//     target: J_pi [rho I | -[Y]x]     host: -J_pi R [rho I | -[x]x]     inverse depth: J_pi t
// With g = J_pi^T n this is J_target = [rho g | Y x g], J_host = -J_target Ad(T_t_h): edgevo's own
// solver sums relative blocks only.
//
// Gauge: the caller fixes poses (the two oldest fix position, rotation and scale) or passes a marginalisation
// prior.
//
// Behind a camera: an observation with Y_z <= 0.001 at the start (the point is closer to the target's plane
// than a thousandth of its depth in the host, or behind it) is excluded from the solve. If a step moves it
// there, it costs as much as a residual of 1000 px, so that no step gains by hiding points.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Pose of a keyframe.
struct BaPose {
  /// Pose, world to camera.
  SE3 T_cam_world;
  /// Whether the pose is fixed.
  bool fixed = false;
};

/// An edge point of a keyframe.
struct BaPoint {
  /// Index into BaProblem::poses.
  int host = 0;
  /// Viewing ray (x, y, 1) in the host camera.
  Eigen::Vector3d ray;
  /// Inverse depth rho > 0 in the host.
  double idepth = 0;
  /// Whether the depth is fixed (low match AND low depth confidence): the point constrains poses only.
  bool fixed = false;
  /// Inverse depth known from before the observations, with its information (1 / variance): a residual of its
  /// own, with Huber's loss. Information 0: nothing is known. Without effect if the depth is fixed.
  double known_idepth = 0, known_information = 0;
};

/// The match of a point in another keyframe.
struct BaObservation {
  /// Index into BaProblem::points; observations of one point are adjacent, points ascend.
  int point = 0;
  /// Index into BaProblem::poses, not the host of the point.
  int target = 0;
  /// Matched position m, pixels.
  Eigen::Vector2d px;
  /// Unit normal n of the edge at m.
  Eigen::Vector2d normal;
  /// 1 / sigma_n, 1/px.
  double inv_sigma_normal = 2;
  /// 1 / sigma_t, 1/px; 0: point-to-tangent only.
  double inv_sigma_tangent = 0;
};

/// A corner seen in two keyframes, without depth: it constrains their relative rotation and the direction of
/// the translation between them (residual and derivatives in src/residuals/corner_residual.h).
struct BaCornerPair {
  /// Indices into BaProblem::poses, different from each other.
  int from = 0, to = 0;
  /// Viewing rays (x, y, 1) in the two cameras.
  Eigen::Vector3d ray_from, ray_to;
  /// 1 / sigma, 1/px.
  double inv_sigma = 2;
};

/// A rotation between two keyframes that another sensor measured, such as a gyro
/// (src/residuals/turn_residual.h).
struct BaTurn {
  /// Indices into BaProblem::poses, different from each other.
  int from = 0, to = 0;
  /// Rotation from the camera `from` to the camera `to`.
  Eigen::Quaterniond R_to_from = Eigen::Quaterniond::Identity();
  /// Inverse of the covariance of w in R <- exp(w) R, rad^-2.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

/// Information of marginalised keyframes and points about the remaining poses: the quadratic
///     E(xi) = 1/2 xi^T H xi + b^T xi + constant,   xi_i = log(T_cam_world_i  linearization_i^-1)
/// Keyframes are identified by `pose_ids` (BaProblem::pose_ids); the linearisation point never moves (first
/// estimate). For an update exp(delta) T the solvers use dxi/ddelta = J_l^-1(xi), the inverse left Jacobian
/// of SE(3), so they minimise E itself.
struct BaPrior {
  /// Ids of the poses (BaProblem::pose_ids), in any order.
  std::vector<int> pose_ids;
  /// T_cam_world at which H and b were formed.
  std::vector<SE3> linearization;
  /// Hessian, 6n x 6n.
  Eigen::MatrixXd H;
  /// Gradient at xi = 0, 6n, in the range of H.
  Eigen::VectorXd b;
  /// Value of E at xi = 0; keeps E and thus every total cost from becoming negative.
  double constant = 0;
};

/// Input and output of one adjustment.
struct BaProblem {
  /// Pinhole of all images, pixels.
  Pinhole pinhole;
  /// Poses of the keyframes, in any order.
  std::vector<BaPose> poses;
  /// Permanent id of each pose, for priors; may be empty without a prior.
  std::vector<int> pose_ids;
  /// Points, with hosts in `poses`.
  std::vector<BaPoint> points;
  /// Observations, ascending in `point`.
  std::vector<BaObservation> observations;
  /// Corners; may be empty.
  std::vector<BaCornerPair> corners;
  /// Rotations by another sensor; may be empty.
  std::vector<BaTurn> turns = {};
  /// Prior from marginalisation, or a gauge.
  std::optional<BaPrior> prior;
};

/// Options of an adjustment.
struct BaOptions {
  /// Maximum number of steps tried.
  int max_iterations = 8;
  /// Width of the Huber loss, sigmas.
  double huber_width = 1.5;
  /// Lower bound of rho in updates.
  double min_idepth = 1e-6;
  /// Share of the cost; smaller decreases end the iteration.
  double relative_decrease = 1e-4;
  /// Damping of the first step, share of the diagonal; a trusted linearisation needs less.
  double initial_damping = 1e-4;
};

/// Result of an adjustment; poses and depths are in the problem.
struct BaResult {
  /// False if there is nothing to solve or values are not finite; poses and depths are then unchanged.
  bool usable = false;
  /// Sum of Huber costs (1/2 r^2 near 0) including the prior, before and after.
  double initial_cost = 0, final_cost = 0;
  /// Number of steps tried, including rejected ones.
  int iterations = 0;
  /// Per point, standard deviation of the inverse depth for fixed poses; 0 for fixed or unobserved points.
  std::vector<double> idepth_sigma;
  /// Per observation, n^T (p' - m) at the solution (at the input if not usable), pixels; 0 if the point is
  /// behind the camera.
  std::vector<double> residual_normal_px;
  /// Per observation, n_perp^T (p' - m) at the same values, pixels, for the match update (Eq.
  /// (distancecheck)).
  std::vector<double> residual_tangent_px;
  /// Per observation, 1 if the point is in front of the camera at the solution, else 0.
  std::vector<char> observation_valid;
};

/// Levenberg-Marquardt on a BaProblem, in place. Deterministic: same problem, same bits. One thread.
/// Throws InputError for a malformed problem: an index out of range, a target that is the host, a corner seen
/// twice in one pose, observations of a point that are not adjacent, a prior whose sizes disagree or which
/// names a pose that the problem does not have.
class BundleAdjuster {
 public:
  virtual ~BundleAdjuster() = default;
  /// Minimises the cost over the free poses and depths.
  virtual BaResult solve(BaProblem* problem, const BaOptions& options) = 0;
  /// Name for make_bundle_adjuster().
  virtual std::string name() const = 0;
};

/// Makes a solver. "schur": edgevo's own solver, scalar depths eliminated, 6x6 pose blocks; the default.
/// "ceres": Ceres with Schur ordering and the same analytic Jacobians; slower, the reference for tests.
/// Throws InputError for any other name.
std::unique_ptr<BundleAdjuster> make_bundle_adjuster(const std::string& name);

/// Covariance of the pose that is marginalised relative to one that stays.
struct RelativeCovariance {
  /// Id of the pose that stays.
  int pose_id = 0;
  /// Covariance of xi in T_leaving_other <- exp(xi) T_leaving_other, tangent [v, w], at the current values.
  /// Zero: unknown.
  Matrix6d covariance = Matrix6d::Zero();
};

/// Marginalises pose `pose_id` (and the problem's prior) out of `problem`: the points that it hosts or sees
/// are eliminated with their observations at the current values (robust weights frozen), its corners with
/// other poses are linearised there, and the result is a prior on the other poses. Poses linearised by the
/// old prior keep that linearisation point (first estimates).
///
/// A fixed pose counts as known: marginalising it conditions on its value, and other fixed poses do not enter
/// the prior, so they have to stay fixed until they are marginalised themselves. A window that starts with
/// the two oldest poses fixed thus passes the gauge to the prior when the second of them leaves.
///
/// `drop_points[i]` is set for the points of the problem that went into the prior and must leave the window.
/// Throws as solve() does, and for an unknown `pose_id`. A problem with non-finite values gives a prior
/// without poses. Cost: one linearisation of the dropped points. `huber_width` and `min_idepth` of the
/// options are used.
///
/// `relative`, unless null, names poses of the problem; their covariances are filled from the information
/// that goes into the prior, before the pose is eliminated. It does not change the result. Cost: one
/// inversion, 6n x 6n.
BaPrior marginalize(const BaProblem& problem, int pose_id, const BaOptions& options,
                    std::vector<bool>* drop_points, std::vector<RelativeCovariance>* relative = nullptr);

}  // namespace edgevo
