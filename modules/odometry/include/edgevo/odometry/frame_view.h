#pragma once
// What the newest frame sees of the map, for displays and live recorders: in the unit of the live poses.
#include <memory>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// A map point in view of the newest frame.
struct SeenPoint {
  Eigen::Vector2f px;      ///< in the undistorted frame, inside the image
  float idepth = 0;        ///< 1/z in the frame's camera, > 0
  float idepth_sigma = 0;  ///< one standard deviation, same unit
  float residual_px = 0;   ///< along the normal of the nearest edge pixel; NaN where none lies within the search radius
};

/// The newest frame with the map points that it sees.
struct FrameView {
  std::shared_ptr<const FramePyramid> pyramid;  ///< undistorted image and its edges; null before the first frame
  std::vector<SeenPoint> points;                ///< empty unless the frame has a pose
  int reference_keyframe = -1;                  ///< changes when a new keyframe became the reference; -1: no map
};

}  // namespace edgevo
