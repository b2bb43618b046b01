#pragma once
// Where the metre of a run comes from, as --scale names it.
#include <optional>
#include <string>

#include "edgevo/core/vehicle_track.h"

namespace edgevo {

/// What says how long a unit of the run is.
struct ScaleSource {
  /// kNone leaves the unit arbitrary.
  enum class Kind { kNone, kFactor, kOdometry, kGps, kRobotPose, kCameraHeight };
  Kind kind = Kind::kNone;  ///< what it is
  double value = 0;           ///< metres per unit (factor), metres over the ground (camera_height); else 0
  std::string text = "none";  ///< as it was given

  /// The sensor of the vehicle that it needs; nullopt for those that need none.
  std::optional<VehicleSensor> sensor() const;
  /// It has to be measured along the run: neither none nor factor.
  bool is_estimated() const { return sensor().has_value() || kind == Kind::kCameraHeight; }
};

/// Reads none, factor=2.5, odometry, gps, robot_pose or camera_height=1.65. Throws InputError for anything else: it says what is wrong,
/// the nearest name, and what to give.
ScaleSource parse_scale_source(const std::string& option);

}  // namespace edgevo
