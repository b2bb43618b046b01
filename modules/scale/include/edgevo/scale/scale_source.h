// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where the metric scale of a run comes from, as --scale names it.
#include <optional>
#include <string>

#include "edgevo/core/vehicle_track.h"

namespace edgevo {

/// What determines the length of a unit of the run.
struct ScaleSource {
  /// Kind of source; kNone leaves the unit arbitrary.
  enum class Kind { kNone, kFactor, kOdometry, kGps, kRobotPose, kCameraHeight };
  /// Kind of this source.
  Kind kind = Kind::kNone;
  /// Metres per unit (factor) or metres over the ground (camera_height); else 0.
  double value = 0;
  /// Text of the option as given.
  std::string text = "none";

  /// The vehicle sensor this source needs; nullopt if it needs none.
  std::optional<VehicleSensor> sensor() const;
  /// True if the scale has to be measured along the run: any kind but none and factor.
  bool is_estimated() const { return sensor().has_value() || kind == Kind::kCameraHeight; }
};

/// Parses none, factor=2.5, odometry, gps, robot_pose or camera_height=1.65. Throws InputError for anything
/// else, which says what is wrong, the nearest name, and what to give.
ScaleSource parse_scale_source(const std::string& option);

}  // namespace edgevo
