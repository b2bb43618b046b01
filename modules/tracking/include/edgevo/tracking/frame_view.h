// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the newest frame sees of the map, for displays and live recorders, in the unit of the live poses.
#include <memory>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// A map point in view of the newest frame.
struct SeenPoint {
  /// Pixel in the undistorted frame, inside the image.
  Eigen::Vector2f px;
  /// Inverse depth 1/z in the frame's camera, > 0.
  float idepth = 0;
  /// Standard deviation of `idepth`.
  float idepth_sigma = 0;
  /// Residual along the normal of the nearest edge pixel, in pixels; NaN if none lies within the search
  /// radius.
  float residual_px = 0;
};

/// The newest frame with the map points that it sees.
struct FrameView {
  /// Undistorted image and its edges; null before the first frame.
  std::shared_ptr<const FramePyramid> pyramid;
  /// Map points in view; empty unless the frame has a pose.
  std::vector<SeenPoint> points;
  /// Id of the reference keyframe; -1: no map.
  int reference_keyframe = -1;
};

}  // namespace edgevo
