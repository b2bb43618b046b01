#include "edgevo/bundle_adjustment/bundle_adjustment.h"

#include <cmath>

#include "edgevo/core/error.h"
#include "normal_equations.h"
#include "solvers.h"

namespace edgevo {
namespace {

// d pi(Y) / d Y, in pixels.
Eigen::Matrix<double, 2, 3> projection_jacobian(const Pinhole& c, const Eigen::Vector3d& Y) {
  const double inv = 1.0 / Y.z();
  Eigen::Matrix<double, 2, 3> J;
  J << c.fx * inv, 0, -c.fx * Y.x() * inv * inv, 0, c.fy * inv, -c.fy * Y.y() * inv * inv;
  return J;
}

// Rows of the edge's own axes over their standard deviations.
Eigen::Matrix2d whitening(const BaObservation& o) {
  Eigen::Matrix2d W;
  W << o.inv_sigma_normal * o.normal.x(), o.inv_sigma_normal * o.normal.y(),  //
      -o.inv_sigma_tangent * o.normal.y(), o.inv_sigma_tangent * o.normal.x();
  return W;
}

// d (rho times the point) for a left perturbation of the frame that the point is in.
Eigen::Matrix<double, 3, 6> point_jacobian(double idepth, const Eigen::Vector3d& scaled_point) {
  Eigen::Matrix<double, 3, 6> J;
  J << idepth * Eigen::Matrix3d::Identity(), -skew(scaled_point);
  return J;
}

}  // namespace

BaLinearization linearize(const Pinhole& pinhole, const SE3& T_target_world, const SE3& T_host_world,
                          const BaPoint& point, const BaObservation& observation) {
  BaLinearization lin;
  const SE3 T_target_host = T_target_world * T_host_world.inverse();
  const Eigen::Matrix3d R = T_target_host.R();
  const Eigen::Vector3d Y = R * point.ray + point.idepth * T_target_host.translation();
  lin.valid = Y.z() > ba::kMinDepthRatio;
  if (!lin.valid) return lin;
  const Eigen::Matrix2d W = whitening(observation);
  const Eigen::Matrix<double, 2, 3> J_Y = W * projection_jacobian(pinhole, Y);
  lin.residual = W * (pinhole.project(Y) - observation.px);  // Eq. (reprojectionerror), in the edge's axes
  lin.J_target = J_Y * point_jacobian(point.idepth, Y);
  lin.J_host = -J_Y * R * point_jacobian(point.idepth, point.ray);
  lin.J_idepth = J_Y * T_target_host.translation();
  return lin;
}

std::unique_ptr<BundleAdjuster> make_bundle_adjuster(const std::string& name) {
  if (name == "schur") return ba::make_schur_solver();
  if (name == "ceres") return ba::make_ceres_solver();
  const std::string nearest = nearest_name(name, {"schur", "ceres"});
  throw InputError("bundle adjuster", "'" + name + "' is not known",
                   "use schur or ceres; did you mean " + nearest + "?");
}

namespace ba {

BaResult unusable_result(const BaProblem& problem) {
  BaResult result;
  result.idepth_sigma.assign(problem.points.size(), 0.0);
  fill_residuals(problem, &result);
  return result;
}

void fill_residuals(const BaProblem& problem, BaResult* result) {
  const std::size_t n = problem.poses.size(), count = problem.observations.size();
  std::vector<RelativePose> relative;
  relative.reserve(n * n);
  for (const BaPose& host : problem.poses)
    for (const BaPose& target : problem.poses)
      relative.push_back(relative_pose(target.T_cam_world, host.T_cam_world));
  result->residual_normal_px.assign(count, 0.0);
  result->residual_tangent_px.assign(count, 0.0);
  result->observation_valid.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const BaObservation& o = problem.observations[i];
    const BaPoint& p = problem.points[o.point];
    const RelativePose& T = relative[p.host * n + o.target];
    const Eigen::Vector3d Y = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(T.R) * p.ray +
                              p.idepth * Eigen::Map<const Eigen::Vector3d>(T.t);
    if (!(Y.z() > kMinDepthRatio)) continue;
    const Eigen::Vector2d e = problem.pinhole.project(Y) - o.px;
    if (!e.allFinite() || !o.normal.allFinite()) continue;
    result->residual_normal_px[i] = o.normal.dot(e);
    result->residual_tangent_px[i] = o.normal.x() * e.y() - o.normal.y() * e.x();
    result->observation_valid[i] = 1;
  }
}

void fill_sigmas(const PackedProblem& packed, const std::vector<double>& idepth_information, std::size_t point_count,
                 BaResult* result) {
  result->idepth_sigma.assign(point_count, 0.0);
  for (std::size_t i = 0; i < packed.points.size(); ++i)
    if (!packed.points[i].fixed && idepth_information[i] > kMinIdepthInformation)
      result->idepth_sigma[packed.points[i].index] = 1.0 / std::sqrt(idepth_information[i]);
}

void store(const State& state, BaProblem* problem) {
  for (std::size_t i = 0; i < state.poses.size(); ++i)
    if (!problem->poses[i].fixed) problem->poses[i].T_cam_world = state.poses[i];
  for (std::size_t i = 0; i < state.idepth.size(); ++i)
    if (!problem->points[i].fixed) problem->points[i].idepth = state.idepth[i];
}

}  // namespace ba
}  // namespace edgevo
