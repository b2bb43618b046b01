// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The samples that a gyro next to the camera of a scene would give, with the errors that such gyros have, and
// what they are.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/se3.h"
#include "edgevo/gyro/gyro_model.h"

namespace edgevo {

/// Samples of an inertial sensor, and the truth about it.
struct SimulatedGyro {
  /// Samples in the order of their times, in the clock of the gyro.
  std::vector<GyroSample> samples;
  /// Rotation, offset, bias at the middle of the time, and scales; its covariance says nothing.
  GyroModel truth;
  /// Bias at the last sample, rad/s.
  Eigen::Vector3d last_bias = Eigen::Vector3d::Zero();
  /// Acceleration that it shows too much, m/s^2.
  Eigen::Vector3d acceleration_bias = Eigen::Vector3d::Zero();
  /// Up in the axes of the camera at the first image.
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  /// Samples a second; white noise, rad/s over the root of a hertz; samples that are missing, 0 to 1.
  double rate_hz = 0, noise = 0, dropped = 0;
};

/// "phone", "drone", "robot".
std::vector<std::string> gyro_kinds();

/// Simulates a gyro of a kind from `begin_s` to `end_s`. `T_scene_cam_at`: pose at any time in seconds, scene
/// axes (z up). Throws InputError for an unknown kind. The same seed gives the same samples.
SimulatedGyro simulate_gyro(const std::function<SE3(double)>& T_scene_cam_at, double begin_s, double end_s,
                            const std::string& kind, uint64_t seed);

/// Text of imu.txt, as DM-VIO and TUM-VI have it: nanoseconds, rad/s and, where they are measured, m/s^2.
std::string imu_text(const std::vector<GyroSample>& samples);
/// Text of gyro_truth.yaml.
std::string gyro_truth_text(const SimulatedGyro& gyro, const std::string& kind);

}  // namespace edgevo
