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

constexpr int kBias = 3, kOffset = 6, kScale = 7;  // places among the unknowns

}  // namespace

double GyroModel::rotation_sigma() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance.topLeftCorner<3, 3>());
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
}

bool GyroModel::is_observed() const {
  constexpr double kObserved = rad(1);  // a turn of 90 degrees is then known to 1.5
  return rotation_sigma() < kObserved;
}

void GyroModel::move(const Eigen::Matrix<double, kGyroUnknowns, 1>& by) {
  R_cam_gyro = (rotation_of(by.head<3>()) * R_cam_gyro).normalized();
  errors.bias += by.segment<3>(kBias);
  offset_s += by[kOffset];
  errors.scale += by.segment<3>(kScale);
}

GyroModel gyro_before_use() {
  constexpr double kAnyAngle = 1.8, kBiasSigma = rad(3), kOffsetSigma = 0.1, kScaleSigma = 0.02;
  GyroModel model;
  model.covariance.setZero();
  model.covariance.diagonal().head<3>().setConstant(kAnyAngle * kAnyAngle);
  model.covariance.diagonal().segment<3>(kBias).setConstant(kBiasSigma * kBiasSigma);
  model.covariance(kOffset, kOffset) = kOffsetSigma * kOffsetSigma;
  model.covariance.diagonal().tail<3>().setConstant(kScaleSigma * kScaleSigma);
  return model;
}

std::string describe(const GyroModel& model) {
  const Eigen::Vector3d turn = rotation_vector(model.R_cam_gyro), b = model.errors.bias;
  char text[240];
  std::snprintf(text, sizeof text,
                "turned by (%.1f, %.1f, %.1f) degrees to the camera (+- %.2f), its clock %+.1f ms (+- %.1f), "
                "bias (%.3f, %.3f, %.3f) degrees/s",
                deg(turn.x()), deg(turn.y()), deg(turn.z()), deg(model.rotation_sigma()),
                1e3 * model.offset_s, 1e3 * std::sqrt(model.covariance(kOffset, kOffset)), deg(b.x()),
                deg(b.y()), deg(b.z()));
  return text;
}

std::optional<CameraTurn> camera_turn(const GyroIntegrator& gyro, const GyroModel& model, double begin,
                                      double end) {
  const auto in_gyro = gyro.rotation(begin + model.offset_s, end + model.offset_s, model.errors);
  if (!in_gyro) return std::nullopt;
  const Eigen::Matrix3d C = model.R_cam_gyro.toRotationMatrix();
  CameraTurn turn;
  turn.R = (model.R_cam_gyro * in_gyro->R * model.R_cam_gyro.conjugate()).normalized();
  GyroJacobian& J = turn.by_unknowns;
  J.leftCols<3>() = Eigen::Matrix3d::Identity() - turn.R.toRotationMatrix();
  J.middleCols<3>(kBias) = C * in_gyro->by_bias;
  J.col(kOffset) = C * (in_gyro->R * in_gyro->rate_begin - in_gyro->rate_end);
  J.rightCols<3>() = C * in_gyro->by_scale;
  turn.noise = C * in_gyro->covariance * C.transpose();
  turn.covariance = turn.noise + J * model.covariance * J.transpose();
  return turn;
}

}  // namespace edgevo
