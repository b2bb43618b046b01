// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where the metric scale of a run comes from, as --scale names it.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/vehicle_track.h"

namespace edgevo {

/// What determines the length of a unit of the run.
struct ScaleSource {
  /// Kind of source; kNone leaves the unit arbitrary, kKeptMap is that of a map given with --map.
  enum class Kind { kNone, kFactor, kOdometry, kGps, kRobotPose, kCameraHeight, kKeptMap };
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

/// All sources that --scale names.
struct ScaleSources {
  /// In the order given, at least one; several are all estimated ones of different kinds.
  std::vector<ScaleSource> list{ScaleSource()};
  /// Text of the option as given.
  std::string text = "none";

  ScaleSources() = default;
  /// One source.
  ScaleSources(ScaleSource source)  // NOLINT(google-explicit-constructor): a list of one
      : list{source}, text(std::move(source.text)) {}
  /// True if the scale has to be measured along the run.
  bool is_estimated() const { return list.front().is_estimated(); }
  /// The height of the camera over the ground, metres, if it is one of them.
  std::optional<double> camera_height() const;
};

/// Parses none, factor=2.5, or a list without repetitions of odometry, gps, robot_pose and
/// camera_height=1.65, separated by commas. Throws InputError for anything else, which says what is wrong,
/// the nearest name, and what to give.
ScaleSources parse_scale_sources(const std::string& option);

/// What Run::scale_source says of a run whose metres are those of the map it was found in; no option.
inline constexpr const char* kKeptMapScale = "kept map";

/// The sources that Run::scale_source names: what --scale takes, or kKeptMapScale.
ScaleSources recorded_scale_sources(const std::string& scale_source);

}  // namespace edgevo
