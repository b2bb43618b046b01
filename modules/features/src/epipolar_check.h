// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How many corners agree with the odometry's poses, whatever their depths: each must lie where a point in
// front of the camera that saw it some frames ago can be seen.
#include <cstdint>
#include <vector>

#include "corner_tracks.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Compares each corner with where it was eight to sixteen frames ago.
class EpipolarCheck {
 public:
  /// Adds a frame with its pose in the odometry's path. Returns the share of the corners that agree; NaN if
  /// fewer than ten are old enough.
  double add(const CornerView& view, const SE3& T_cam_odometry);
  /// Forgets what was seen: another map begins.
  void restart() { seen_.clear(); }

 private:
  struct View {
    Eigen::Vector3d ray = Eigen::Vector3d::Zero();
    SE3 T_cam_odometry;
  };
  struct Seen {
    uint32_t id = 0;
    int frames = 0;  // since `newer`
    bool has_older = false;
    View older, newer;  // eight frames apart
  };
  std::vector<Seen> seen_;  // by ascending id
};

}  // namespace edgevo
