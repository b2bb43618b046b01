// SPDX-License-Identifier: BSD-3-Clause
#include "epoch_constraints.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

// Two poses that are one within rounding still have a standard deviation, in median depths of a first map.
constexpr double kLeastPosition = 1e-6;

double variance_of(double sigma) { return sigma * sigma; }
Sim3 to_sim3(const SE3& T) { return {1, T}; }

}  // namespace

Matrix7d covariance_of(double position, double rotation, double scale) {
  Vector7d variances;
  variances << Eigen::Vector3d::Constant(variance_of(std::max(position, kLeastPosition))),
      Eigen::Vector3d::Constant(variance_of(rotation)), variance_of(scale);
  return variances.asDiagonal();
}

Constraint between_maps(const Constraint& c, const SE3& T_map_from, const SE3& T_map_to, double scale) {
  Constraint moved = c;
  moved.T_from_to = to_sim3(T_map_from) * Sim3{scale, c.T_from_to.rigid} * to_sim3(T_map_to).inverse();
  moved.centre = T_map_from * c.T_from_to.rigid.translation();
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_map_from.R();
  moved.covariance.topLeftCorner<6, 6>() = turn * c.covariance.topLeftCorner<6, 6>() * turn.transpose();
  moved.covariance.topRightCorner<6, 1>() = turn * c.covariance.topRightCorner<6, 1>();
  moved.covariance.bottomLeftCorner<1, 6>() = moved.covariance.topRightCorner<6, 1>().transpose();
  return moved;
}

Constraint in_world_unit(const Constraint& c, double scale_from, const std::optional<UnknownPose>& where) {
  Constraint place = c;
  place.T_from_to = {1, SE3(c.T_from_to.rigid.rotation(), scale_from * c.T_from_to.rigid.translation())};
  place.centre *= scale_from;
  Vector6d unit = Vector6d::Ones();
  unit.head<3>().setConstant(scale_from);
  place.covariance.setZero();
  place.covariance.topLeftCorner<6, 6>() =
      unit.asDiagonal() * c.covariance.topLeftCorner<6, 6>() * unit.asDiagonal();
  place.failure.reset();
  if (where) place.failure = mistaken(place.covariance, {scale_from * where->position, where->rotation});
  return place;
}

Constraint::Failure mistaken(const Matrix7d& covariance, const UnknownPose& unknown) {
  const double scale = covariance(6, 6) > 0 ? kUnknownScale : 0;
  Constraint::Failure failure{0, covariance + covariance_of(unknown.position, unknown.rotation, scale)};
  const int measured = scale > 0 && std::isfinite(covariance(6, 6)) ? 7 : 6;
  const auto log_det = [&](const Matrix7d& m) {
    return m.topLeftCorner(measured, measured).ldlt().vectorD().array().log().sum();
  };
  // ln det Sigma_failed - 2 ln(p / (1 - p)) - ln det Sigma = kMistakenFrom
  const double log_odds = 0.5 * (log_det(failure.covariance) - log_det(covariance) - kMistakenFrom);
  failure.probability = std::min(1 / (1 + std::exp(-log_odds)), std::nextafter(1.0, 0.0));
  return failure;
}

bool measures_unit(const Constraint& c) { return std::isfinite(c.covariance(6, 6)); }
bool measures_place(const Constraint& c) { return c.covariance.topLeftCorner<6, 6>().allFinite(); }

Constraint with_uncertain_scale(Constraint c) {
  constexpr double kLeastVariance = 1e-12;
  if (c.covariance(6, 6) == 0) c.covariance(6, 6) = kLeastVariance;
  if (c.failure && c.failure->covariance(6, 6) == 0) c.failure->covariance(6, 6) = kLeastVariance;
  return c;
}

Constraint of_scale_alone(const Constraint& c) {
  Constraint scale = c;
  scale.T_from_to = {c.T_from_to.scale, SE3()};
  scale.centre.setZero();
  scale.covariance = covariance_of_scale(std::sqrt(c.covariance(6, 6)));
  if (scale.failure)
    scale.failure->covariance =
        covariance_of_scale(std::sqrt(std::max(c.covariance(6, 6), c.failure->covariance(6, 6))));
  return scale;
}

}  // namespace edgevo
