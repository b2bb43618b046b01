#pragma once
// Local bundle adjustment over a window of keyframes: poses and host inverse depths (paper, Eq. (reprojectionerror)).
//
// A point lives in its host keyframe h as viewing ray x = (x, y, 1) and inverse depth rho. In keyframe t it projects to
//     Y = R x + rho t,   T_t_h = T_t_world T_h_world^-1 = (R, t),   p' = pi(Y)        (Y is the point times rho)
// Its match in t is an edge pixel m with unit normal n (image gradient) and edge direction n_perp. The residual is taken in the
// edge's own axes and whitened:
//     r_n = n^T (p' - m) / sigma_n          always (point to tangent, Eq. (edgeerror))
//     r_t = n_perp^T (p' - m) / sigma_t     for photometric matches (2-D residual); left out where the match is ambiguous
// and Huber's loss is applied to the norm of (r_n, r_t).
// Derivatives, for the left perturbation T_cam_world <- exp(xi) T_cam_world:
//     target: J_pi [rho I | -[Y]x]     host: -J_pi R [rho I | -[x]x]     inverse depth: J_pi t
// Gauge: the caller fixes poses (the two oldest hold position, rotation and scale) or hands over a marginalisation prior.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

struct BaPose {
  SE3 T_cam_world;
  bool fixed = false;
};

struct BaPoint {
  int host = 0;                 ///< index into BaProblem::poses
  Eigen::Vector3d ray;          ///< (x, y, 1) in the host camera
  double idepth = 0;            ///< rho > 0
  bool fixed = false;           ///< low match AND low depth confidence: constrains poses only
};

struct BaObservation {
  int point = 0;                ///< index into BaProblem::points; observations of one point are adjacent, points ascend
  int target = 0;               ///< index into BaProblem::poses, not the host of the point
  Eigen::Vector2d px;           ///< matched position m, pixels
  Eigen::Vector2d normal;       ///< unit normal n of the edge at m
  double inv_sigma_normal = 2;  ///< 1/px
  double inv_sigma_tangent = 0; ///< 1/px; 0: point-to-tangent only
};

/// What marginalised keyframes and points still say about the remaining poses: the quadratic
///     E(xi) = 1/2 xi^T H xi + b^T xi,   xi_i = log(T_cam_world_i  linearization_i^-1)
/// Keyframes are named by `pose_ids` (see BaProblem::pose_ids); the linearisation point never moves (first estimate).
struct BaPrior {
  std::vector<int> pose_ids;
  std::vector<SE3> linearization;  ///< T_cam_world at which H and b were formed
  Eigen::MatrixXd H;               ///< 6n x 6n
  Eigen::VectorXd b;               ///< 6n
};

struct BaProblem {
  Pinhole pinhole;
  std::vector<BaPose> poses;
  std::vector<int> pose_ids;       ///< a lasting name for each pose, so that a prior finds it; may be empty without prior
  std::vector<BaPoint> points;
  std::vector<BaObservation> observations;
  std::optional<BaPrior> prior;
};

struct BaOptions {
  int max_iterations = 8;
  double huber_width = 1.5;        ///< in sigmas
  double min_idepth = 1e-6;        ///< an update never takes rho below it
  double relative_decrease = 1e-4; ///< stop when the cost falls by less than this share
};

struct BaResult {
  bool usable = false;             ///< false: nothing to solve or not finite; poses and depths are then untouched
  double initial_cost = 0, final_cost = 0;  ///< sum of Huber costs, prior included
  int iterations = 0;
  std::vector<double> idepth_sigma;         ///< per point, poses held; 0 for fixed or unobserved points
  std::vector<double> residual_normal_px;   ///< per observation, at the solution
  std::vector<double> residual_tangent_px;  ///< per observation n_perp^T (p' - m), for the match update (Eq. (distancecheck))
};

/// Levenberg-Marquardt on a BaProblem, in place. Deterministic: same problem, same bits. One thread.
class BundleAdjuster {
 public:
  virtual ~BundleAdjuster() = default;
  virtual BaResult solve(BaProblem* problem, const BaOptions& options) = 0;
  virtual std::string name() const = 0;
};

/// "schur": own solver, scalar depths eliminated, 6x6 pose blocks; the default. "ceres": Ceres with Schur ordering and the same
/// analytic Jacobians; slower, the reference that the own solver is tested against. Throws InputError for another name.
std::unique_ptr<BundleAdjuster> make_bundle_adjuster(const std::string& name);

/// Marginalises pose `pose_id` (and the problem's prior) out of `problem`: all points hosted by it, and the points seen from
/// it, are eliminated with their observations at their current values, and what remains is a prior on the other poses. Poses that
/// the old prior already linearised keep that linearisation point (first estimates).
/// `drop_points[i]` tells which points of the problem went into the prior and must leave the window.
BaPrior marginalize(const BaProblem& problem, int pose_id, const BaOptions& options, std::vector<bool>* drop_points);

/// Residual and Jacobians of one observation; public for the tests and for both solvers.
struct BaLinearization {
  bool valid = false;                         ///< false: behind the camera
  Eigen::Vector2d residual;                   ///< (r_n, r_t), whitened; r_t = 0 where inv_sigma_tangent = 0
  Eigen::Matrix<double, 2, 6> J_target, J_host;
  Eigen::Vector2d J_idepth;
};
BaLinearization linearize(const Pinhole& pinhole, const SE3& T_target_world, const SE3& T_host_world, const BaPoint& point,
                          const BaObservation& observation);

}  // namespace edgevo
