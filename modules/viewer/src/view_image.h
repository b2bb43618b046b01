// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The newest frame as a picture: its edges, and the map's points on them in colour.
#include <opencv2/core.hpp>

#include "edgevo/tracking/frame_view.h"

namespace edgevo {

/// What the colour of a point shows.
enum class PointColour {
  /// Inverse depth: blue far, red near (5th to 95th percentile of the picture).
  kDepth,
  /// Distance from the edge: green 0, red 3 px or more, or no edge.
  kResidual
};

/// The picture: BGR, 8 bits, of the size of the undistorted image. `view` must hold a pyramid.
cv::Mat draw_frame(const FrameView& view, PointColour colour);

}  // namespace edgevo
