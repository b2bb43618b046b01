// SPDX-License-Identifier: BSD-3-Clause
#include "camera_problem.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

using ba::GlobalDerivative, ba::ImageRate, ba::kUnknowns, ba::ProfileStep, ba::Unknowns, ba::UnknownsSquare;

// Most steps: twice what any estimate took; a search that has not ended by then is used as it is.
constexpr int kMaxNewtonSteps = 8;
// Changes that end the search, as small as 0.03 px at the border of a wide image for k1 and a hundredth of a
// pixel for the read-out time (seconds).
const Unknowns kEnough = Unknowns::Constant(1e-4);
// Share of its standard deviation that the last step may have: too little to change the result.
constexpr double kEnoughSigmas = 0.15;
// Factor on the tolerance of the first solve: its solution is used only until the unknowns move.
constexpr double kRough = 10;
// Derivatives by these alone take half the work.
const CameraMask kRunUnknowns = only({kK1, kReadout});
// Largest factor by which an inverse depth may change: beyond, a linear prediction of a far point is wrong.
constexpr double kMaxIdepthChange = 2;

Eigen::Vector2d normalised(const Pinhole& c, const Eigen::Vector2d& px) { return c.ray(px).head<2>(); }
Eigen::Vector2d pixel(const Pinhole& c, const Eigen::Vector2d& x) {
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

// D = d px_file / d px.
Eigen::Matrix2d pixel_jacobian(const Pinhole& c, const Eigen::Matrix2d& jacobian) {
  const Eigen::Vector2d f(c.fx, c.fy);
  return f.asDiagonal() * jacobian * f.cwiseInverse().asDiagonal();
}

// x(k) with x_file fixed: dx/dk = -(dx_file/dx)^-1 dx_file/dk.
ImageRate removal_rate(const Rectification& r, const CameraError& error, const ImageMotion& motion,
                       const IdealPoint& point) {
  return -(point.jacobian.inverse() * error.derivative(r, motion, point.x));
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

// One Newton step of the free unknowns from k, with the standard deviations of the result; 0 for the others.
struct NewtonStep {
  Unknowns change = Unknowns::Zero(), sigma = Unknowns::Zero();
  UnknownsSquare covariance = UnknownsSquare::Zero();
};
NewtonStep newton_step(const ProfileStep& step, const CameraSearch& search, const Unknowns& k,
                       const CameraMask& free) {
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
  // By the robust covariance, at least as large as the formal one.
  const UnknownsSquare sandwich = inverse * score * inverse;
  Unknowns ratio = Unknowns::Zero();
  for (int i = 0; i < kUnknowns; ++i)
    if (free[i]) {
      n.sigma[i] = std::sqrt(std::max(sandwich(i, i), inverse(i, i)));
      ratio[i] = n.sigma[i] / std::sqrt(sandwich(i, i));
    }
  n.covariance = ratio.asDiagonal() * sandwich * ratio.asDiagonal();
  return n;
}

}  // namespace

const ImageMotion& CameraProblem::motion_of(int pose) const {
  static const ImageMotion unknown;
  return motion.empty() ? unknown : motion[size_t(pose)];
}

IdealPoints ideal_points(const CameraProblem& problem, const CameraError& error) {
  const Rectification& r = problem.rectification;
  const BaProblem& file = problem.file;
  const auto locate = [&](int pose, const Eigen::Vector2d& px_file) {
    const ImageMotion& motion = problem.motion_of(pose);
    const Eigen::Vector2d x = error.from_file(r, motion, normalised(file.pinhole, px_file));
    return IdealPoint{x, error.jacobian(r, motion, x)};
  };
  IdealPoints points;
  points.hosts.reserve(problem.px_host.size()), points.matches.reserve(file.observations.size());
  for (size_t i = 0; i < problem.px_host.size(); ++i)
    points.hosts.push_back(locate(file.points[i].host, problem.px_host[i]));
  for (const BaObservation& o : file.observations) points.matches.push_back(locate(o.target, o.px));
  return points;
}

BaProblem corrected(const CameraProblem& problem, const CameraError& error) {
  return corrected(problem, ideal_points(problem, error));
}

BaProblem corrected(const CameraProblem& problem, const IdealPoints& points) {
  BaProblem p = problem.file;
  for (size_t i = 0; i < p.points.size(); ++i) {
    const Eigen::Vector2d& x = points.hosts[i].x;
    p.points[i].ray = {x.x(), x.y(), 1.0};
  }
  for (size_t k = 0; k < p.observations.size(); ++k) {
    BaObservation& o = p.observations[k];
    const Eigen::Matrix2d D = pixel_jacobian(problem.rectification.target(), points.matches[k].jacobian);
    const Eigen::Vector2d n = D.transpose() * o.normal;
    const double length = n.norm();
    o.px = pixel(p.pinhole, points.matches[k].x);
    o.normal = n / length;
    o.inv_sigma_normal *= length;
    o.inv_sigma_tangent *= length;
  }
  return p;
}

GlobalDerivative camera_derivative(const CameraProblem& problem, const CameraError& error,
                                   const IdealPoints& points) {
  const BaProblem& file = problem.file;
  const auto rate_at = [&](int pose, const IdealPoint& point) {
    return removal_rate(problem.rectification, error, problem.motion_of(pose), point);
  };
  GlobalDerivative d;
  // inv_sigma grows with |D^T n|, which is proportional to 1 + focal. How it changes with the distortion is
  // neglected: second order in the residual.
  d.log_inv_sigma[kFocal] = 1 / (1 + error.correction.focal);
  d.ray.reserve(points.hosts.size()), d.px.reserve(points.matches.size());
  for (size_t i = 0; i < points.hosts.size(); ++i)
    d.ray.push_back(rate_at(file.points[i].host, points.hosts[i]));
  const Eigen::Vector2d f(file.pinhole.fx, file.pinhole.fy);
  for (size_t k = 0; k < points.matches.size(); ++k)
    d.px.push_back(f.asDiagonal() * rate_at(file.observations[k].target, points.matches[k]));
  return d;
}

CameraEstimate estimate_camera(const CameraProblem& problem, const CameraSearch& search,
                               const BaOptions& options) {
  CameraEstimate e;
  e.value = search.start;
  e.free = search.free;
  static_assert(kK1 < ba::kFirstUnknowns && kReadout < ba::kFirstUnknowns);
  const bool only_run_unknowns = (kRunUnknowns || !search.free).all();
  const auto solver = make_bundle_adjuster("schur");
  CameraProblem current = problem;  // its poses and depths follow the solution
  for (int i = 0; i < kMaxNewtonSteps; ++i) {
    const bool rough = i == 0;
    BaOptions solve = options;
    if (rough) solve.relative_decrease *= kRough;
    const IdealPoints points = ideal_points(current, e.value);
    BaProblem p = corrected(current, points);
    const BaResult result = solver->solve(&p, solve);
    if (!result.usable) return e;
    const ProfileStep step =
        ba::profile_step(p, camera_derivative(current, e.value, points), options, only_run_unknowns);
    if (!step.usable) return e;
    const Unknowns k = e.value.unknowns();
    const NewtonStep newton = newton_step(step, search, k, search.free);
    e.cost = result.final_cost;
    e.sigma = newton.sigma;
    e.covariance = newton.covariance;
    e.solution = p;
    e.usable = true;
    const Unknowns next = (k + newton.change).cwiseMax(-search.limit).cwiseMin(search.limit);
    const Unknowns change = search.free.select(next - k, Unknowns::Zero()),
                   enough = kEnough.cwiseMax(kEnoughSigmas * newton.sigma);
    if ((!rough && (change.array().abs() < enough.array()).all()) || i + 1 == kMaxNewtonSteps) break;
    predict(step, change, &p);
    current.file.poses = p.poses;
    for (size_t n = 0; n < p.points.size(); ++n) current.file.points[n].idepth = p.points[n].idepth;
    e.value = CameraError(k + change);
  }
  return e;
}

}  // namespace edgevo
