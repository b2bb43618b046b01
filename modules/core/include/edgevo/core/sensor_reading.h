// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the other sensors of a recording measured, as recorded.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Wheel odometry.
struct OdometryReading {
  /// Pose of the vehicle in any fixed frame, metres.
  SE3 T_odom_vehicle;
  /// Velocities in the vehicle's axes, m/s and rad/s.
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
};

/// Satellite navigation.
struct GpsReading {
  /// WGS84, degrees and metres above the ellipsoid.
  double latitude_deg = 0, longitude_deg = 0, height_m = 0;
};

/// Inertial measurement.
struct ImuReading {
  /// Rotation from the sensor to the world, if there is one.
  std::optional<Eigen::Quaterniond> R_world_imu;
  /// rad/s and m/s^2 (gravity included), in the axes of the sensor.
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero(), acceleration = Eigen::Vector3d::Zero();
};

/// Pose of the vehicle from elsewhere, such as motion capture.
struct PoseReading {
  /// In any fixed frame, metres.
  SE3 T_map_vehicle;
};

/// One measurement.
struct SensorReading {
  /// Time of the measurement, in the clock of the frames.
  Timestamp time;
  /// Name of the sensor.
  std::string label;
  /// Where it is on the vehicle (x forward, y left, z up), metres; identity if not known.
  SE3 T_vehicle_sensor;
  /// What it measured.
  std::variant<OdometryReading, GpsReading, ImuReading, PoseReading> value;
};

/// Gives one measurement after the other in the order of the recording; nullopt at the end.
using SensorReadings = std::function<std::optional<SensorReading>()>;

}  // namespace edgevo
