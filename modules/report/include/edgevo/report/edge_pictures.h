#pragma once
// Pictures of report.html: keyframes with the edge points of the map coloured by inverse depth.
//
// A keyframe hosts only the points that the map lacked when it came. Drawn are therefore the points of the
// keyframes before it, too, as many as stand in the window with it; one that is hidden by now is drawn all
// the same.
#include <functional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// One keyframe.
struct EdgePicture {
  int frame_index = 0;  ///< in the source
  Timestamp time;  ///< of the frame
  int points = 0;  ///< drawn
  std::vector<uint8_t> jpeg;  ///< bytes of the file
};

/// The pictures of one run, with one scale of colours.
struct EdgePictures {
  std::vector<EdgePicture> pictures;       ///< evenly spread over the run
  double idepth_low = 0, idepth_high = 0;  ///< ends of the colours, blue and red, in 1/unit of the run
};

/// Up to `count` keyframes that have points which `filter` keeps. `image_path` tells where the image of a
/// frame lies, as the camera took it; `camera` is the camera of these files. A keyframe whose image is not
/// there is passed over. Cost: 20 ms a picture.
EdgePictures draw_edge_pictures(const Run& run, const Camera& camera, const PointFilter& filter,
                                const std::function<std::string(int frame_index)>& image_path, int count);

}  // namespace edgevo
