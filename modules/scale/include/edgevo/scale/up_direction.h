// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where "up" is for a camera whose mount is not known, from what was seen on a drive.
//
// A vehicle moves along its own axis, so that up is perpendicular to the direction of travel in the camera's
// axes, whatever the hills. What is left is one angle about that direction. Its cues:
//   ground           points that the camera passes, seen along the direction of travel: the ground is a line
//                    at one height to one side, with nothing opposite
//   vertical lines   the most common direction of straight edges across the direction of travel; up or level
//   turns            the axis that the vehicle turns about
// Only the ground distinguishes up from down. Without it, the camera is taken to be less than 60 degrees from
// upright. A hand-held camera has no direction of travel, hence no estimate.
#include <optional>
#include <string>

#include "edgevo/core/input_decision.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// "Up" in the axes of the camera.
struct UpEstimate {
  /// Unit vector, camera axes (x right, y down, z forward).
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  /// Standard deviation of its direction, degrees.
  double sigma_deg = 0;
  /// Angle between it and the upward axis of the images, degrees.
  double tilt_deg = 0;
  /// What it was found from, as a phrase: "direction of travel, ground and vertical lines".
  std::string seen_in;
  /// Whether two cues agree on it, or the ground or the lines with a right angle, and none contradicts.
  bool is_certain = false;
};

/// Estimates up from the poses, points and lines of a run; nullopt if the camera did not travel along one of
/// its directions, or if there is no cue but the travel. Cost: as seen_camera_height().
std::optional<UpEstimate> estimate_up(const Run& run);

/// The mount that an estimate stands for: roll and pitch; the yaw is 0, that of the first camera.
SE3 level_mount(const Eigen::Vector3d& up_in_camera);

/// Gives a run without a mount that of `by_gravity` (up_by_gravity.h), if it is certain and what was seen is
/// not: a vehicle is level in its own axes, on a hill, too. Else it gets the one that was
/// seen, if it is certain and the camera is tilted by more than 7 degrees; else the camera is taken to look
/// straight ahead. Returns the decision, with a doubt if the camera seems tilted all the same. A run with a
/// mount keeps it: a doubt if what was seen differs from it by more than 7 degrees for certain, else nullopt.
/// Call before the run is scaled.
std::optional<InputDecision> decide_up(Run* run, const std::optional<UpEstimate>& by_gravity = std::nullopt);

}  // namespace edgevo
