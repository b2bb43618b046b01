#pragma once
// What is known while a run goes on: for displays and live recorders. Everything is in the world and unit of
// the live poses (FrameRecord::T_world_cam_live): no later knowledge is in it, and a correction of the camera
// may move it.
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Keyframes that have left the window, in the order in which they did.
struct SettledKeyframes {
  int revision = 0;  ///< how often the camera was corrected so far; each time ALL keyframes have moved
  std::vector<KeyframeRecord> keyframes;  ///< as they left
};

/// Keyframes that are still in the window, as they stand: later keyframes move them and add points.
struct UnsettledKeyframes {
  int revision = 0;  ///< as in SettledKeyframes
  int version = 0;   ///< another one after each change of the window; 0: there was none yet
  std::vector<KeyframeRecord> keyframes;  ///< the oldest first; empty while there is no map
};

}  // namespace edgevo
