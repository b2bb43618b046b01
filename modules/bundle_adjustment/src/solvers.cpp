// SPDX-License-Identifier: BSD-3-Clause
#include "solvers.h"

#include <cmath>

#include "edgevo/core/error.h"
#include "normal_equations.h"

namespace edgevo {

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
  std::vector<SE3> poses;
  for (const BaPose& pose : problem.poses) poses.push_back(pose.T_cam_world);
  const std::vector<RelativePose> relative = all_relative_poses(poses);
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

void fill_sigmas(const PackedProblem& packed, const std::vector<double>& idepth_information,
                 std::size_t point_count, BaResult* result) {
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
