// SPDX-License-Identifier: BSD-3-Clause
#include "two_view_solve.h"

#include <algorithm>
#include <cmath>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo {
namespace {

constexpr int kHost = 0, kPrior = 1, kTarget = 2;
constexpr int kMinMatches = 12;

// The noisy depth as an observation in the camera to the side of the host (see the header).
BaObservation depth_prior(const Pinhole& pinhole, const StudyPoint& p, int point) {
  BaObservation o;
  o.point = point;
  o.target = kPrior;
  o.px = p.px + Eigen::Vector2d(pinhole.fx * p.idepth, 0);
  o.normal = Eigen::Vector2d::UnitX();
  o.inv_sigma_normal = 1 / (pinhole.fx * std::max(p.idepth_sigma, 1e-6 * p.idepth));
  return o;
}

BaProblem build_problem(const Pinhole& pinhole, const std::vector<StudyPoint>& points,
                        const std::vector<Match>& matches, const SE3& T_start,
                        std::vector<int>* observation_of) {
  BaProblem problem;
  problem.pinhole = pinhole;
  problem.poses = {
      {SE3(), true}, {SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d::UnitX()), true}, {T_start, false}};
  for (size_t i = 0; i < points.size(); ++i) {
    const Match& m = matches[i];
    if (m.kind == MatchKind::kNone) continue;
    const int point = int(problem.points.size());
    problem.points.push_back(
        {kHost, pinhole.ray(points[i].px), points[i].idepth, m.kind == MatchKind::kEdgeFixed});
    problem.observations.push_back(depth_prior(pinhole, points[i], point));
    (*observation_of)[i] = int(problem.observations.size());
    problem.observations.push_back({point, kTarget, m.px, m.normal, m.inv_sigma_normal, m.inv_sigma_tangent});
  }
  return problem;
}

}  // namespace

TwoViewSolution solve_two_view(const Pinhole& pinhole, const std::vector<StudyPoint>& points,
                               const std::vector<Match>& matches, const SE3& T_start) {
  TwoViewSolution solution;
  std::vector<int> observation_of(points.size(), -1);
  BaProblem problem = build_problem(pinhole, points, matches, T_start, &observation_of);
  if (int(problem.points.size()) < kMinMatches) return solution;
  BaOptions options;
  options.max_iterations = 20;
  const BaResult result = make_bundle_adjuster("schur")->solve(&problem, options);
  if (!result.usable || !problem.poses[kTarget].T_cam_world.is_finite()) return solution;
  solution.usable = true;
  solution.T_target_host = problem.poses[kTarget].T_cam_world;
  solution.residual_normal_px.assign(points.size(), 0);
  solution.residual_tangent_px.assign(points.size(), 0);
  for (size_t i = 0; i < points.size(); ++i) {
    const int k = observation_of[i];
    solution.idepth.push_back(k < 0 ? points[i].idepth
                                    : problem.points[size_t(problem.observations[size_t(k)].point)].idepth);
    if (k < 0) continue;
    solution.residual_normal_px[i] = result.residual_normal_px[size_t(k)];
    solution.residual_tangent_px[i] = result.residual_tangent_px[size_t(k)];
  }
  return solution;
}

}  // namespace edgevo
