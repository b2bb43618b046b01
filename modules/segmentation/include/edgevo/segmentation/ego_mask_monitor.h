// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a run does about parts that are fixed to the camera (segmentation/src/ego_mask_finder.h): when a map
// must wait, and what is said.
#include <memory>
#include <string>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Follows the mask from frame to frame.
class EgoMaskMonitor {
 public:
  /// Takes the next frame. Returns true if its mask covers something else than that of the last change.
  bool take(const FramePyramid& frame);
  /// One line about the last change.
  const std::string& description() const { return description_; }
  /// Whether no map is to be made of a frame in which a part may be fixed to the camera
  /// (ViewMasks::may_show_ego_part). Never for long.
  bool delays_map(bool may_show_ego_part);

 private:
  std::shared_ptr<const Plane<uint8_t>> newest_;
  double share_ = 0;
  int delayed_ = 0;
  std::string description_;
};

}  // namespace edgevo
