#pragma once
// What is known while a run goes on: for displays and live recorders. Everything is in the world and unit of the live poses
// (FrameRecord::T_world_cam_live): no later knowledge is in it, and a correction of the camera may move it.
#include <memory>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// A point of the map where the newest frame sees it.
struct LivePoint {
  Eigen::Vector2f px;      ///< in the undistorted frame, inside the image
  float idepth = 0;        ///< 1/z in the frame's camera, > 0
  float idepth_sigma = 0;  ///< one standard deviation, same unit
  float residual_px = 0;   ///< along the normal of the nearest edge pixel; NaN where no edge lies within the search radius
};

struct LiveView {
  std::shared_ptr<const FramePyramid> pyramid;  ///< of the newest frame: undistorted image and its edges; null before the first
  std::vector<LivePoint> points;                ///< empty unless the newest frame has a pose
  int reference_keyframe = -1;                  ///< changes when a new keyframe became the reference; -1: no map
};

/// Keyframes that have left the window, in the order in which they did.
struct SettledKeyframes {
  int revision = 0;  ///< how often the camera was corrected so far; each time ALL keyframes have moved
  std::vector<KeyframeRecord> keyframes;
};

}  // namespace edgevo
