// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Pictures of report.html: keyframes with the edge points of the map coloured by inverse depth.
//
// A keyframe hosts only points that the map lacked before it. The points of the keyframes before it are
// therefore drawn as well, even those that are occluded in its image.
#include <functional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Picture of one frame.
struct EdgePicture {
  /// Index of the frame in the source.
  int frame_index = 0;
  /// Time of the frame.
  Timestamp time;
  /// Number of points drawn.
  int points = 0;
  /// Bytes of the JPEG file.
  std::vector<uint8_t> jpeg;
};

/// Pictures of one run, with a common colour scale.
struct EdgePictures {
  /// Pictures in time order, evenly spread over the run.
  std::vector<EdgePicture> pictures;
  /// Inverse depths at the blue and the red end of the colour scale, 1/unit of the run.
  double idepth_low = 0, idepth_high = 0;
};

/// Draws up to `count` keyframes that host points which `filter` keeps. `image_path` returns the file of a
/// frame's raw image; `camera` is the camera of these files. Keyframes without an image are skipped. Cost: 20
/// ms a picture.
EdgePictures draw_edge_pictures(const Run& run, const Camera& camera, const PointFilter& filter,
                                const std::function<std::string(int frame_index)>& image_path, int count);

/// The same for the most doubtful frame of each of the `count` longest doubtful intervals; a frame without a
/// pose is drawn without points.
EdgePictures draw_doubtful_pictures(const Run& run, const Camera& camera, const PointFilter& filter,
                                    const std::function<std::string(int frame_index)>& image_path, int count);

}  // namespace edgevo
