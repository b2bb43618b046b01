// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How a gyro sits next to a camera, and the rotations of the camera that follow from its samples.
#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "edgevo/gyro/gyro_integrator.h"

namespace edgevo {

/// Unknowns of a GyroModel: rotation (3), bias (3), offset, scales (3), drift.
constexpr int kGyroUnknowns = 11;
/// Where the bias begins.
constexpr int kGyroBias = 3;
/// Where the offset is.
constexpr int kGyroOffset = 6;
/// Where the scales begin.
constexpr int kGyroScale = 7;
/// Where the drift is.
constexpr int kGyroDrift = 10;
/// Clocks of gyro and camera may differ by this, seconds: more is another recording's.
constexpr double kMostGyroOffsetS = 0.2;
/// A change of these.
using GyroChange = Eigen::Matrix<double, kGyroUnknowns, 1>;
/// Covariance of these.
using GyroCovariance = Eigen::Matrix<double, kGyroUnknowns, kGyroUnknowns>;
/// Derivative of a rotation by these.
using GyroJacobian = Eigen::Matrix<double, 3, kGyroUnknowns>;

/// Where the gyro is turned to, its clock and its errors, with their covariance.
struct GyroModel {
  /// Turns vectors from the axes of the gyro to those of the camera.
  Eigen::Quaterniond R_cam_gyro = Eigen::Quaterniond::Identity();
  /// Time that the gyro's clock shows less that of the camera's, seconds, at `at_s` of GyroIntegrator's
  /// count.
  double offset_s = 0, at_s = 0;
  /// Seconds that it gains a second.
  double drift = 0;
  /// Bias and errors of the scales.
  GyroErrors errors;
  /// Covariance of theta in R <- exp(theta) R, bias, offset, scales and drift; of what nothing has shown yet
  /// that which gyros have (gyro_before_use()).
  GyroCovariance covariance = GyroCovariance::Identity();

  /// Largest standard deviation of the rotation about any axis, radians.
  double rotation_sigma() const;
  /// Whether all three angles of the rotation are known, to kObserved: the camera has turned about two axes.
  bool is_observed() const;
  /// Whether its axes are left-handed: the scale of one, or of all, is negative.
  bool is_mirrored() const { return (Eigen::Vector3d::Ones() + errors.scale).prod() < 0; }
  /// The offset at a time, seconds.
  double offset_at(double t) const { return offset_s + drift * (t - at_s); }
  /// Adds a change of the unknowns.
  void move(const GyroChange& by);
  /// The change of the unknowns that makes this model the other one.
  GyroChange change_to(const GyroModel& other) const;
  /// Goes on to a later time: the clock has gained, and the bias may have changed as that of a MEMS gyro
  /// does.
  void go_on_to(double t);
};

/// What is known of a gyro that nobody has measured: nothing of its rotation, and errors as those of phones
/// and drones are (datasheets: 0.5 to 3 degrees/s, 1 to 3 %).
GyroModel gyro_before_use();

/// One line: rotation, offset and bias, as "gyro: ..." says them.
std::string describe(const GyroModel& model);

/// Rotation of the camera between two times.
struct CameraTurn {
  /// p_end = R p_begin for points at infinity.
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  /// Covariance of delta in R <- exp(delta) R, by the noise of the gyro and by what is not known of it.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// The part of the noise.
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  /// The part, about each axis, by which it is as unsure as it is likely that the gyro does not turn with the
  /// camera, rad^2.
  double broken2 = 0;
  /// Derivative of delta by the unknowns.
  GyroJacobian by_unknowns = GyroJacobian::Zero();
};

/// Rotation of the camera from `begin` to `end`, seconds of the camera's clock in GyroIntegrator's count;
/// nothing where samples are missing. Cost: 2 microseconds for a thirtieth of a second.
std::optional<CameraTurn> camera_turn(const GyroIntegrator& gyro, const GyroModel& model, double begin,
                                      double end);

}  // namespace edgevo
