// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a run does about parts that are fixed to the camera (segmentation/src/cell_labels.h): when a map
// must wait, and what is said.
#include <memory>
#include <string>

#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/segmentation/still_cells.h"

namespace edgevo {

/// Follows the mask from frame to frame.
class EgoMaskMonitor {
 public:
  /// Takes the next frame. Returns true if its mask covers something else than that of the last change.
  bool take(const FramePyramid& frame);
  /// One line about the last change.
  const std::string& description() const { return description_; }
  /// Whether no map is to be made of a frame and one `images` before it: a part may be fixed to the camera
  /// (ViewMasks::may_show_ego_part), or the camera has seemed to stand since (StillCells), and what moves
  /// crosses it. At most 30 frames are delayed for the one.
  bool delays_map(bool may_show_ego_part, const StillCells& still, int images);

 private:
  std::shared_ptr<const Plane<uint8_t>> newest_;
  double share_ = 0;
  int delayed_ = 0;
  std::string description_;
};

}  // namespace edgevo
