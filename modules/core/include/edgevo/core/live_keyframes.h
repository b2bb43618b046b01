// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keyframes available during a run, for displays and live recorders. Everything is in the world frame and
// unit of the live poses (FrameRecord::T_world_cam_live): it contains no later information, and a correction
// of the camera may move it.
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Keyframes that have been marginalised, in that order.
struct MarginalisedKeyframes {
  /// Number of camera corrections so far; each one moves ALL keyframes.
  int revision = 0;
  /// Records as of their marginalisation.
  std::vector<KeyframeRecord> keyframes;
};

/// Keyframes in the window, in their current state: later keyframes move them and add points.
struct ActiveKeyframes {
  /// Number of camera corrections so far.
  int revision = 0;
  /// Changes with each change of the window; 0: no window yet.
  int version = 0;
  /// Records, oldest first; empty while there is no map.
  std::vector<KeyframeRecord> keyframes;
};

}  // namespace edgevo
