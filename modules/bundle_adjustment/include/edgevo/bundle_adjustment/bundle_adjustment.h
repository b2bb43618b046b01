#pragma once
// Local bundle adjustment over a window of keyframes: poses and host inverse depths.
// Source: paper, Eq. (reprojectionerror).
//
// A point lives in its host keyframe h as viewing ray x = (x, y, 1) and inverse depth rho. In keyframe t:
//     Y = R x + rho t,   T_t_h = T_t_world T_h_world^-1 = (R, t),   p' = pi(Y)    (Y: the point times rho)
// Its match in t is an edge pixel m with unit normal n (image gradient) and edge direction
// n_perp = (-n_y, n_x). The residual is taken in the edge's own axes and whitened:
//     r_n = n^T (p' - m) / sigma_n          always (point to tangent, Eq. (edgeerror))
//     r_t = n_perp^T (p' - m) / sigma_t     photometric matches only; left out where a match is ambiguous
// and Huber's loss is applied to the norm of (r_n, r_t) by iteratively re-weighted least squares.
//
// Derivatives, for the left perturbation T_cam_world <- exp(xi) T_cam_world:
//     target: J_pi [rho I | -[Y]x]     host: -J_pi R [rho I | -[x]x]     inverse depth: J_pi t
// With g = J_pi^T n this is J_target = [rho g | Y x g], J_host = -J_target Ad(T_t_h): the own solver sums
// relative blocks only.
//
// Gauge: the caller fixes poses (the two oldest hold position, rotation and scale) or hands over a
// marginalisation prior.
//
// Behind a camera: an observation with Y_z <= 0.001 at the start (the point is nearer to the target's plane
// than a thousandth of its depth in the host, or behind it) is left out of the solve. One that a step carries
// there costs what a miss by 1000 px costs, so that no step gains by hiding points.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// A keyframe.
struct BaPose {
  SE3 T_cam_world;  ///< world to camera
  bool fixed = false;  ///< held as it is
};

/// An edge point of a keyframe.
struct BaPoint {
  int host = 0;         ///< index into BaProblem::poses
  Eigen::Vector3d ray;  ///< (x, y, 1) in the host camera
  double idepth = 0;    ///< rho > 0
  bool fixed = false;   ///< low match AND low depth confidence: constrains poses only
};

/// The match of a point in another keyframe.
struct BaObservation {
  int point = 0;   ///< index into BaProblem::points; observations of one point are adjacent, points ascend
  int target = 0;  ///< index into BaProblem::poses, not the host of the point
  Eigen::Vector2d px;            ///< matched position m, pixels
  Eigen::Vector2d normal;        ///< unit normal n of the edge at m
  double inv_sigma_normal = 2;   ///< 1/px
  double inv_sigma_tangent = 0;  ///< 1/px; 0: point-to-tangent only
};

/// A corner seen in two keyframes. Nothing is known of its depth: it speaks for their rotation against each
/// other and for the direction of the translation between them (src/residuals/corner_residual.h has residual
/// and derivatives).
struct BaCornerPair {
  int from = 0, to = 0;              ///< indices into BaProblem::poses, not the same
  Eigen::Vector3d ray_from, ray_to;  ///< (x, y, 1) in the two cameras
  double inv_sigma = 2;              ///< 1/px
};

/// What marginalised keyframes and points still say about the remaining poses: the quadratic
///     E(xi) = 1/2 xi^T H xi + b^T xi + constant,   xi_i = log(T_cam_world_i  linearization_i^-1)
/// Keyframes are named by `pose_ids` (see BaProblem::pose_ids); the linearisation point never moves (first
/// estimate). For an update exp(delta) T the solvers use dxi/ddelta = J_l^-1(xi), the inverse left Jacobian
/// of SE(3), so they minimise E itself.
struct BaPrior {
  std::vector<int> pose_ids;  ///< ascending or not; names of BaProblem::pose_ids
  std::vector<SE3> linearization;  ///< T_cam_world at which H and b were formed
  Eigen::MatrixXd H;               ///< 6n x 6n
  Eigen::VectorXd b;               ///< 6n, in the range of H
  double constant = 0;  ///< E at xi = 0; keeps E, and with it every total cost, from going negative
};

/// All that one adjustment works on.
struct BaProblem {
  Pinhole pinhole;  ///< of all images, pixels
  std::vector<BaPose> poses;  ///< in any order; the caller's keyframes
  std::vector<int> pose_ids;  ///< a lasting name for each pose, for priors; may be empty without one
  std::vector<BaPoint> points;  ///< hosts as in `poses`
  std::vector<BaObservation> observations;  ///< ascending in `point`
  std::vector<BaCornerPair> corners;  ///< may be empty
  std::optional<BaPrior> prior;  ///< of what was marginalised, or a gauge
};

/// How an adjustment is run.
struct BaOptions {
  int max_iterations = 8;  ///< steps tried, at most
  double huber_width = 1.5;         ///< in sigmas
  double min_idepth = 1e-6;         ///< an update never takes rho below it
  double relative_decrease = 1e-4;  ///< stop when the cost falls by less than this share
  /// Of the first step, share of the diagonal; a trusted linearisation wants less.
  double initial_damping = 1e-4;
};

/// What an adjustment found; poses and depths are in the problem.
struct BaResult {
  bool usable = false;  ///< false: nothing to solve or not finite; poses and depths are then untouched
  double initial_cost = 0, final_cost = 0;  ///< sum of Huber costs (1/2 r^2 near 0), prior included
  int iterations = 0;                       ///< steps tried, rejected ones included
  std::vector<double> idepth_sigma;         ///< per point, poses held; 0 for fixed or unobserved points
  /// Per observation, n^T (p' - m) at the solution (the input where not usable); 0 where the point is behind
  /// the camera.
  std::vector<double> residual_normal_px;
  /// Per observation n_perp^T (p' - m), for the match update (Eq. (distancecheck)); likewise.
  std::vector<double> residual_tangent_px;
  std::vector<char> observation_valid;  ///< per observation: 0 where behind the camera at the solution
};

/// Levenberg-Marquardt on a BaProblem, in place. Deterministic: same problem, same bits. One thread.
/// Throws InputError for a malformed problem: an index out of range, a target that is the host, a corner seen
/// twice in one pose, observations of a point that are not adjacent, a prior whose sizes disagree or which
/// names a pose that the problem does not have.
class BundleAdjuster {
 public:
  virtual ~BundleAdjuster() = default;
  /// Moves poses and depths that are not fixed to the least cost.
  virtual BaResult solve(BaProblem* problem, const BaOptions& options) = 0;
  /// as make_bundle_adjuster() knows it
  virtual std::string name() const = 0;
};

/// "schur": own solver, scalar depths eliminated, 6x6 pose blocks; the default. "ceres": Ceres with Schur
/// ordering and the same analytic Jacobians; slower, the reference that the own solver is tested against.
/// Throws InputError for another name.
std::unique_ptr<BundleAdjuster> make_bundle_adjuster(const std::string& name);

/// Marginalises pose `pose_id` (and the problem's prior) out of `problem`: all points hosted by it, and the
/// points seen from it, are eliminated with their observations at their current values (robust weights
/// frozen), its corners with other poses are linearised there, and what remains is a prior on the other
/// poses. Poses that the old prior already linearised keep that linearisation point (first estimates).
///
/// A fixed pose counts as known: marginalising it conditions on
/// its value, and other fixed poses do not enter the prior, hence have to stay fixed until they are
/// marginalised themselves. So windows that start with the two oldest poses fixed hand the gauge on to the
/// prior when the second of them leaves.
///
/// `drop_points[i]` tells which points of the problem went into the
/// prior and must leave the window. Throws as solve() does, and for an unknown `pose_id`. A problem with
/// non-finite values gives a prior without poses. Cost: one linearisation of the dropped points.
/// `huber_width` and `min_idepth` of the options are used.
BaPrior marginalize(const BaProblem& problem, int pose_id, const BaOptions& options,
                    std::vector<bool>* drop_points);

}  // namespace edgevo
