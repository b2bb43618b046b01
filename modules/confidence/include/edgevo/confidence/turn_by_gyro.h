// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The turn over the last ten frames as reported, against that of a gyro.
#include <Eigen/Geometry>
#include <deque>
#include <functional>
#include <limits>
#include <optional>

#include "edgevo/core/timestamp.h"
#include "edgevo/gyro/gyro_model.h"

namespace edgevo {

/// How far two rotations differ.
struct TurnDifference {
  /// Angle between the turn as reported and that of the gyro, degrees; NaN without a gyro that knows it.
  double angle_deg = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the gyro's about the same axis, degrees; NaN likewise.
  double sigma_deg = std::numeric_limits<double>::quiet_NaN();
};

/// Compares turns over ten frames; for the tracking thread.
class TurnByGyro {
 public:
  /// Rotation of the camera between two times by a gyro; nothing if it does not know.
  using Turn = std::function<std::optional<CameraTurn>(Timestamp, Timestamp)>;
  /// Adds a frame that has a pose; compares over as many frames as there are. Cost: that of `turn`, 20
  /// microseconds for a third of a second.
  TurnDifference add(Timestamp time, const Eigen::Quaterniond& R_cam_map, const Turn& turn);
  /// A frame has no pose, or a new map begins.
  void interrupt() { frames_.clear(); }

 private:
  struct Posed {
    Timestamp time;
    Eigen::Quaterniond R_cam_map;
  };
  std::deque<Posed> frames_;  // up to ten before the newest one, oldest first
};

}  // namespace edgevo
