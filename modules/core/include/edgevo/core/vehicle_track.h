// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Positions of the vehicle measured by another sensor (wheel odometry, GPS, motion capture): the metric
// reference for a monocular run.
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Sensor of a recording: wheel odometry, GPS, or a robot pose (such as motion capture).
enum class VehicleSensor { kOdometry, kGps, kRobotPose };

/// One measured position.
struct VehiclePosition {
  /// Time of the measurement.
  Timestamp time;
  /// Position in any fixed right-handed frame, metres.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// Recording of one sensor.
struct VehicleTrack {
  /// Positions in time order.
  std::vector<VehiclePosition> positions;
  /// Point on the vehicle that moves along these positions (such as an antenna), in the vehicle's axes
  /// (x forward, y left, z up), metres.
  Eigen::Vector3d sensor_on_vehicle = Eigen::Vector3d::Zero();
};

/// Recordings of one vehicle, by sensor.
using VehicleTracks = std::map<VehicleSensor, VehicleTrack>;

/// The longest of the tracks by name, in time order, each time once, from its first position on.
VehicleTrack longest_track(std::map<std::string, VehicleTrack> tracks);

}  // namespace edgevo
