// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/gyro/gyro_model.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

#include "edgevo/core/angle.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/core/se3.h"

namespace edgevo {
namespace {

// Change of the bias, rad/s over the root of a second: 0.05 degrees/s in a minute, as a MEMS gyro warms up.
constexpr double kBiasWalk = rad(0.05) / 7.7;

}  // namespace

double GyroModel::rotation_sigma() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance.topLeftCorner<3, 3>());
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
}

bool GyroModel::is_observed() const {
  constexpr double kObserved = rad(1);  // a turn of 90 degrees is then known to 1.5
  return rotation_sigma() < kObserved;
}

void GyroModel::move(const GyroChange& by) {
  R_cam_gyro = (rotation_of(by.head<3>()) * R_cam_gyro).normalized();
  errors.bias += by.segment<3>(kGyroBias);
  offset_s += by[kGyroOffset];
  errors.scale += by.segment<3>(kGyroScale);
  drift += by[kGyroDrift];
}

GyroChange GyroModel::change_to(const GyroModel& other) const {
  GyroChange by;
  by << rotation_vector(other.R_cam_gyro * R_cam_gyro.conjugate()), other.errors.bias - errors.bias,
      other.offset_at(at_s) - offset_s, other.errors.scale - errors.scale, other.drift - drift;
  return by;
}

void GyroModel::go_on_to(double t) {
  if (!(t > at_s)) return;
  const double dt = t - at_s;
  offset_s = offset_at(t);
  at_s = t;
  GyroCovariance& P = covariance;
  P.row(kGyroOffset) += dt * P.row(kGyroDrift);
  P.col(kGyroOffset) += dt * P.col(kGyroDrift);
  P.diagonal().segment<3>(kGyroBias).array() += kBiasWalk * kBiasWalk * dt;
}

GyroModel gyro_before_use() {
  constexpr double kAnyAngle = 1.8, kBiasSigma = rad(3), kOffsetSigma = 0.1, kScaleSigma = 0.02;
  constexpr double kDriftSigma = 1e-3;  // stamps by the time of arrival; crystals are ten times better
  GyroModel model;
  model.covariance.setZero();
  model.covariance.diagonal().head<3>().setConstant(kAnyAngle * kAnyAngle);
  model.covariance.diagonal().segment<3>(kGyroBias).setConstant(kBiasSigma * kBiasSigma);
  model.covariance(kGyroOffset, kGyroOffset) = kOffsetSigma * kOffsetSigma;
  model.covariance.diagonal().segment<3>(kGyroScale).setConstant(kScaleSigma * kScaleSigma);
  model.covariance(kGyroDrift, kGyroDrift) = kDriftSigma * kDriftSigma;
  return model;
}

namespace {

// Scales and drift, where they are known not to be zero.
std::string describe_rates(const GyroModel& model) {
  constexpr double kSigmas = 3;
  const Eigen::Vector3d& s = model.errors.scale;
  const auto sigma = [&](int i) { return std::sqrt(model.covariance(i, i)); };
  bool is_off = false;
  for (int i = 0; i < 3; ++i) is_off = is_off || std::abs(s[i]) > kSigmas * sigma(kGyroScale + i);
  char text[160];
  std::string found = model.is_mirrored() ? ", an axis is mirrored" : "";
  if (is_off) {
    std::snprintf(text, sizeof text, ", scales off by (%.1f, %.1f, %.1f) %%", 100 * s.x(), 100 * s.y(),
                  100 * s.z());
    found += text;
  }
  if (std::abs(model.drift) > kSigmas * sigma(kGyroDrift)) {
    std::snprintf(text, sizeof text, ", its clock gains %.2f ms a second", 1e3 * model.drift);
    found += text;
  }
  return found;
}

}  // namespace

std::string describe(const GyroModel& model) {
  const Eigen::Vector3d turn = rotation_vector(model.R_cam_gyro), b = model.errors.bias;
  char text[240];
  std::snprintf(text, sizeof text,
                "turned by (%.1f, %.1f, %.1f) degrees to the camera (+- %.2f), its clock %+.1f ms (+- %.1f), "
                "bias (%.3f, %.3f, %.3f) degrees/s",
                deg(turn.x()), deg(turn.y()), deg(turn.z()), deg(model.rotation_sigma()),
                1e3 * model.offset_s, 1e3 * std::sqrt(model.covariance(kGyroOffset, kGyroOffset)), deg(b.x()),
                deg(b.y()), deg(b.z()));
  return text + describe_rates(model);
}

std::optional<CameraTurn> camera_turn(const GyroIntegrator& gyro, const GyroModel& model, double begin,
                                      double end) {
  const auto in_gyro =
      gyro.rotation(begin + model.offset_at(begin), end + model.offset_at(end), model.errors);
  if (!in_gyro) return std::nullopt;
  const Eigen::Matrix3d C = model.R_cam_gyro.toRotationMatrix();
  CameraTurn turn;
  turn.R = (model.R_cam_gyro * in_gyro->R * model.R_cam_gyro.conjugate()).normalized();
  const Eigen::Vector3d by_begin = C * (in_gyro->R * in_gyro->rate_begin), by_end = -C * in_gyro->rate_end;
  GyroJacobian& J = turn.by_unknowns;
  J.leftCols<3>() = Eigen::Matrix3d::Identity() - turn.R.toRotationMatrix();
  J.middleCols<3>(kGyroBias) = C * in_gyro->by_bias;
  J.col(kGyroOffset) = by_begin + by_end;
  J.middleCols<3>(kGyroScale) = C * in_gyro->by_scale;
  J.col(kGyroDrift) = (begin - model.at_s) * by_begin + (end - model.at_s) * by_end;
  turn.noise = C * in_gyro->covariance * C.transpose();
  turn.covariance = turn.noise + J * model.covariance * J.transpose();
  return turn;
}

}  // namespace edgevo
