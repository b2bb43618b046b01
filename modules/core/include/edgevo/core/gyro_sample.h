// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a gyro measured, as every source gives it.
#include <Eigen/Core>
#include <functional>
#include <optional>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// One measurement of a gyro, and of the accelerometer in its case.
struct GyroSample {
  /// Time of the measurement, in the clock of the frames.
  Timestamp time;
  /// Angular velocity in the right-handed axes of the gyro, rad/s.
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  /// Acceleration with gravity, which points up at rest, in the same axes, m/s^2; zero: not measured.
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
};

/// Gives one sample after the other, in the order of their times; nullopt at the end.
using GyroReadings = std::function<std::optional<GyroSample>()>;

}  // namespace edgevo
