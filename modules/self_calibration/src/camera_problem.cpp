// SPDX-License-Identifier: BSD-3-Clause
#include "camera_problem.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "edgevo/core/radial.h"

namespace edgevo {
namespace {

using ba::GlobalDerivative, ba::ImageRate, ba::kUnknowns, ba::ProfileStep, ba::Unknowns, ba::UnknownsSquare;

// Most steps: twice what any estimate took; a search that has not ended by then is used as it is.
constexpr int kMaxNewtonSteps = 8;
// Changes of k1 and of the read-out time (seconds) that end the search: 0.03 px at the border of a wide
// image, and a hundredth of a pixel.
const Unknowns kEnough(1e-4, 1e-4);
// Share of its standard deviation that the last step may have: too little to change the result.
constexpr double kEnoughSigmas = 0.15;
// Factor on the tolerance of the first solve: its solution is used only until the unknowns move.
constexpr double kRough = 10;
// Largest factor by which an inverse depth may change: beyond, a linear prediction of a far point is wrong.
constexpr double kMaxIdepthChange = 2;

Eigen::Vector2d normalised(const Pinhole& c, const Eigen::Vector2d& px) { return c.ray(px).head<2>(); }
Eigen::Vector2d pixel(const Pinhole& c, const Eigen::Vector2d& x) {
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

// D = d px_file / d px at the true normalised point x.
Eigen::Matrix2d pixel_jacobian(const Rectification& r, const ImageCorrection& correction,
                               const ImageMotion& motion, const Eigen::Vector2d& x) {
  const Eigen::Vector2d f(r.target().fx, r.target().fy);
  return f.asDiagonal() * file_jacobian(r, correction, motion, x) * f.cwiseInverse().asDiagonal();
}

// x(k) with x_file fixed: dx/dk = -(dx_file/dx)^-1 dx_file/dk.
ImageRate removal_rate(const Rectification& r, const ImageCorrection& correction, const ImageMotion& motion,
                       const Eigen::Vector2d& x) {
  const Eigen::Vector2d rolling = add_rolling(r, correction.readout_s, motion, x);
  ImageRate by_unknown;
  by_unknown.col(0) = radial_derivative(rolling);
  by_unknown.col(1) =
      radial_jacobian(correction.k1, rolling) * rolling_rate(r, correction.readout_s, motion, x);
  return -(file_jacobian(r, correction, motion, x).inverse() * by_unknown);
}

void predict(const ProfileStep& step, const Unknowns& change, BaProblem* problem) {
  const Eigen::VectorXd pose_change = step.pose_rate * change;
  for (size_t i = 0; i < problem->poses.size(); ++i)
    if (!problem->poses[i].fixed)
      problem->poses[i].T_cam_world = SE3::exp(pose_change.segment<6>(6 * i)) * problem->poses[i].T_cam_world;
  for (size_t i = 0; i < problem->points.size(); ++i) {
    BaPoint& p = problem->points[i];
    if (p.fixed) continue;
    const double predicted = p.idepth + step.idepth_rate[i].dot(change);
    p.idepth = std::clamp(predicted, p.idepth / kMaxIdepthChange, kMaxIdepthChange * p.idepth);
  }
}

using Mask = Eigen::Array<bool, kUnknowns, 1>;

// One Newton step of the free unknowns from k, with the standard deviations of the result; 0 for the others.
struct NewtonStep {
  Unknowns change = Unknowns::Zero(), sigma = Unknowns::Zero();
};
NewtonStep newton_step(const ProfileStep& step, const CameraSearch& search, const Unknowns& k,
                       const Mask& free) {
  const Unknowns weight = search.prior_sigma.cwiseAbs2().cwiseInverse();
  UnknownsSquare curvature = step.curvature, score = step.score_square;
  curvature.diagonal() += weight;
  Unknowns gradient = step.gradient + weight.cwiseProduct(k - search.prior);
  for (int i = 0; i < kUnknowns; ++i)
    if (!free[i]) {
      curvature.row(i).setZero(), curvature.col(i).setZero();
      score.row(i).setZero(), score.col(i).setZero();
      curvature(i, i) = 1, gradient[i] = 0;
    }
  const UnknownsSquare inverse = curvature.inverse();
  NewtonStep n;
  n.change = -inverse * gradient;
  const Unknowns sandwich = (inverse * score * inverse).diagonal();
  for (int i = 0; i < kUnknowns; ++i)
    if (free[i]) n.sigma[i] = std::sqrt(std::max(sandwich[i], inverse(i, i)));
  return n;
}

}  // namespace

const ImageMotion& CameraProblem::motion_of(int pose) const {
  static const ImageMotion unknown;
  return motion.empty() ? unknown : motion[size_t(pose)];
}

BaProblem corrected(const CameraProblem& problem, const ImageCorrection& correction) {
  BaProblem p = problem.file;
  const Rectification& r = problem.rectification;
  const Pinhole& c = p.pinhole;
  for (size_t i = 0; i < p.points.size(); ++i) {
    const Eigen::Vector2d x =
        from_file(r, correction, problem.motion_of(p.points[i].host), normalised(c, problem.px_host[i]));
    p.points[i].ray = {x.x(), x.y(), 1.0};
  }
  for (BaObservation& o : p.observations) {
    const ImageMotion& motion = problem.motion_of(o.target);
    const Eigen::Vector2d x = from_file(r, correction, motion, normalised(c, o.px));
    const Eigen::Vector2d n = pixel_jacobian(r, correction, motion, x).transpose() * o.normal;
    const double length = n.norm();
    o.px = pixel(c, x);
    o.normal = n / length;
    o.inv_sigma_normal *= length;
    o.inv_sigma_tangent *= length;
  }
  return p;
}

GlobalDerivative camera_derivative(const CameraProblem& problem, const ImageCorrection& correction) {
  const Rectification& r = problem.rectification;
  const Pinhole& c = problem.file.pinhole;
  const auto rate_at = [&](int pose, const Eigen::Vector2d& px_file) {
    const ImageMotion& motion = problem.motion_of(pose);
    return removal_rate(r, correction, motion, from_file(r, correction, motion, normalised(c, px_file)));
  };
  GlobalDerivative d;
  d.ray.reserve(problem.px_host.size()), d.px.reserve(problem.file.observations.size());
  for (size_t i = 0; i < problem.px_host.size(); ++i)
    d.ray.push_back(rate_at(problem.file.points[i].host, problem.px_host[i]));
  const Eigen::Vector2d f(c.fx, c.fy);
  for (const BaObservation& o : problem.file.observations)
    d.px.push_back(f.asDiagonal() * rate_at(o.target, o.px));
  return d;
}

CameraEstimate estimate_camera(const CameraProblem& problem, const CameraSearch& search,
                               const BaOptions& options) {
  CameraEstimate e;
  e.value = search.start;
  e.free = search.free;
  const auto solver = make_bundle_adjuster("schur");
  CameraProblem current = problem;  // its poses and depths follow the solution
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const bool rough = i == 0;
    BaOptions solve = options;
    if (rough) solve.relative_decrease *= kRough;
    BaProblem p = corrected(current, e.value);
    const BaResult result = solver->solve(&p, solve);
    if (!result.usable) return e;
    const ProfileStep step = ba::profile_step(p, camera_derivative(current, e.value), options);
    if (!step.usable) return e;
    const Unknowns k = unknowns(e.value);
    const NewtonStep newton = newton_step(step, search, k, search.free),
                     all = newton_step(step, search, k, Mask::Constant(true));
    e.cost = result.final_cost;
    e.sigma = search.free.select(newton.sigma, all.sigma);
    e.if_all_free = k + all.change;
    e.solution = p;
    e.usable = true;
    const Unknowns next = (k + newton.change).cwiseMax(-search.limit).cwiseMin(search.limit);
    const Unknowns change = search.free.select(next - k, Unknowns::Zero()),
                   enough = kEnough.cwiseMax(kEnoughSigmas * newton.sigma);
    if ((!rough && (change.array().abs() < enough.array()).all()) || i + 1 == kMaxNewtonSteps) break;
    predict(step, change, &p);
    current.file.poses = p.poses;
    for (size_t n = 0; n < p.points.size(); ++n) current.file.points[n].idepth = p.points[n].idepth;
    e.value = correction(k + change);
  }
  return e;
}

}  // namespace edgevo
