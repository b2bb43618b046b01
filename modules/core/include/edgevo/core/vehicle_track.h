#pragma once
// Where another sensor says that the vehicle was: wheel odometry, GPS, a motion capture. It measures the metre for a monocular run.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

enum class VehicleSensor { kOdometry, kGps, kRobotPose };

struct VehiclePosition {
  Timestamp time;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, in any fixed frame with right-handed axes
};

struct VehicleTrack {
  std::vector<VehiclePosition> positions;  ///< in time order
  /// What moves along these positions (an antenna, say), in the vehicle's axes (x forward, y left, z up), metres.
  Eigen::Vector3d sensor_on_vehicle = Eigen::Vector3d::Zero();
};

}  // namespace edgevo
