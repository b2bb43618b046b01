#pragma once
// The newest frame as a picture: its edges, and on them the points of the map in colour.
#include <opencv2/core.hpp>

#include "edgevo/odometry/frame_view.h"

namespace edgevo {

enum class PointColour {
  kDepth,    ///< by inverse depth: blue far, red near (from the 5th to the 95th percentile of the picture)
  kResidual  ///< by distance from the edge: green 0, red 3 px or more, or no edge there
};

/// BGR, 8 bits, of the size of the undistorted image. `view` must hold a pyramid.
cv::Mat draw_frame(const FrameView& view, PointColour colour);

}  // namespace edgevo
