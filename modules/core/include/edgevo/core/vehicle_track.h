#pragma once
// Where another sensor says that the vehicle was: wheel odometry, GPS, a motion capture. It measures the metre for a monocular run.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Which sensor of a rawlog: wheel odometry, GPS, or a robot pose (such as motion capture).
enum class VehicleSensor { kOdometry, kGps, kRobotPose };

/// One measured position.
struct VehiclePosition {
  Timestamp time;  ///< of the measurement
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, in any fixed frame with right-handed axes
};

/// What one sensor recorded.
struct VehicleTrack {
  std::vector<VehiclePosition> positions;  ///< in time order
  /// What moves along these positions (an antenna, say), in the vehicle's axes (x forward, y left, z up), metres.
  Eigen::Vector3d sensor_on_vehicle = Eigen::Vector3d::Zero();
};

}  // namespace edgevo
