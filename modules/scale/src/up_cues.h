// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cues for up on a drive (up_direction.h): the direction of travel, and those of the angle about it.
#include <cmath>
#include <map>
#include <optional>

#include "edgevo/core/records.h"
#include "edgevo/scale/path.h"

namespace edgevo {

constexpr double kPi = 3.14159265358979323846;

/// The direction of travel in the camera's axes, and two axes across it.
struct TravelAxes {
  Eigen::Vector3d forward, down, right;
  /// Standard deviation of `forward`, radians.
  double sigma = 0;

  /// The direction across the travel at an angle, radians from `down` to `right`.
  Eigen::Vector3d across(double angle) const { return std::cos(angle) * down + std::sin(angle) * right; }
  /// The angle of a direction's part across the travel.
  double angle_of(const Eigen::Vector3d& v) const { return std::atan2(v.dot(right), v.dot(down)); }
};

/// An angle about the direction of travel at which "down" lies, radians, or one that differs from it by a
/// multiple of `period`.
struct UpCue {
  const char* name = "";
  double angle = 0, sigma = 0, period = 0;
};

/// A run with the paths of its keyframes, by segment, and the median depth of its points.
struct Drive {
  const Run* run = nullptr;
  std::map<int, Path> paths;
  double depth = 0;
};

Drive drive_of(const Run& run);

/// nullopt if the camera did not move along one of its directions for most of a path of some length.
std::optional<TravelAxes> travel_axes(const Drive& drive);

/// The ground; period 2 pi.
std::optional<UpCue> ground_cue(const Drive& drive, const TravelAxes& axes);
/// Vertical lines, or level ones across the travel; period pi / 2.
std::optional<UpCue> line_cue(const Drive& drive, const TravelAxes& axes);
/// The axis of the turns; period pi.
std::optional<UpCue> turn_cue(const Drive& drive, const TravelAxes& axes);

}  // namespace edgevo
