#include "radial_problem.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "edgevo/core/radial.h"

namespace edgevo::ba {
namespace {

constexpr int kMaxNewtonSteps = 8;
constexpr double kEnough = 1e-4;  // of k1: 0.03 px at the border of a wide image
constexpr double kRough = 10;     // the first solve may stop so much earlier: its solution serves only until k1 moves

Eigen::Vector2d normalised(const Pinhole& c, const Eigen::Vector2d& px) { return c.ray(px).head<2>(); }
Eigen::Vector2d pixel(const Pinhole& c, const Eigen::Vector2d& x) { return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy}; }

// D = d px_file / d px at the true normalised point x.
Eigen::Matrix2d pixel_jacobian(const Pinhole& c, double k1, const Eigen::Vector2d& x) {
  const Eigen::Vector2d f(c.fx, c.fy);
  return f.asDiagonal() * radial_jacobian(k1, x) * f.cwiseInverse().asDiagonal();
}

// x(k1) with x_file held: dx/dk1 = -(dx_file/dx)^-1 dx_file/dk1.
Eigen::Vector2d removal_rate(double k1, const Eigen::Vector2d& x) {
  return -(radial_jacobian(k1, x).inverse() * radial_derivative(x));
}

void predict(const ProfileStep& step, double change, BaProblem* problem) {
  for (size_t i = 0; i < problem->poses.size(); ++i)
    if (!problem->poses[i].fixed)
      problem->poses[i].T_cam_world = SE3::exp(change * step.pose_rate.segment<6>(6 * i)) * problem->poses[i].T_cam_world;
  for (size_t i = 0; i < problem->points.size(); ++i) {
    BaPoint& p = problem->points[i];
    if (!p.fixed) p.idepth = std::clamp(p.idepth + change * step.idepth_rate[i], 0.5 * p.idepth, 2.0 * p.idepth);
  }
}

}  // namespace

BaProblem without_radial(const RadialProblem& problem, double k1) {
  BaProblem p = problem.file;
  const Pinhole& c = p.pinhole;
  for (size_t i = 0; i < p.points.size(); ++i) {
    const Eigen::Vector2d x = remove_radial(k1, normalised(c, problem.px_host[i]));
    p.points[i].ray = {x.x(), x.y(), 1.0};
  }
  for (BaObservation& o : p.observations) {
    const Eigen::Vector2d x = remove_radial(k1, normalised(c, o.px));
    const Eigen::Vector2d n = pixel_jacobian(c, k1, x).transpose() * o.normal;
    const double stretch = n.norm();
    o.px = pixel(c, x);
    o.normal = n / stretch;
    o.inv_sigma_normal *= stretch;
    o.inv_sigma_tangent *= stretch;
  }
  return p;
}

GlobalDerivative k1_derivative(const RadialProblem& problem, double k1) {
  const Pinhole& c = problem.file.pinhole;
  GlobalDerivative d;
  for (const Eigen::Vector2d& px : problem.px_host) d.ray.push_back(removal_rate(k1, remove_radial(k1, normalised(c, px))));
  for (const BaObservation& o : problem.file.observations) {
    const Eigen::Vector2d rate = removal_rate(k1, remove_radial(k1, normalised(c, o.px)));
    d.px.push_back({c.fx * rate.x(), c.fy * rate.y()});
  }
  return d;
}

RadialEstimate estimate_k1(const RadialProblem& problem, double start, double prior_sigma, double limit, const BaOptions& options) {
  RadialEstimate e;
  e.k1 = start;
  const auto solver = make_bundle_adjuster("schur");
  RadialProblem current = problem;  // its poses and depths follow the solution
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const bool rough = i == 0;
    BaOptions solve = options;
    if (rough) solve.relative_decrease *= kRough;
    BaProblem p = without_radial(current, e.k1);
    const BaResult result = solver->solve(&p, solve);
    if (!result.usable) return e;
    e.cost = result.final_cost;
    const ProfileStep step = profile_step(p, k1_derivative(current, e.k1), options);
    if (!step.usable) return e;
    const double prior_weight = 1.0 / (prior_sigma * prior_sigma), curvature = step.curvature + prior_weight;
    e.sigma = std::sqrt(std::max(step.score_square, step.curvature)) / curvature;
    const double next = std::clamp(e.k1 - (step.gradient + prior_weight * e.k1) / curvature, -limit, limit);
    const double change = next - e.k1;
    e.solution = p;
    e.usable = true;
    if ((!rough && std::abs(change) < std::max(kEnough, 0.15 * e.sigma)) || i + 1 == kMaxNewtonSteps) break;
    predict(step, change, &p);
    current.file.poses = p.poses;
    for (size_t k = 0; k < p.points.size(); ++k) current.file.points[k].idepth = p.points[k].idepth;
    e.k1 = next;
  }
  return e;
}

}  // namespace edgevo::ba
