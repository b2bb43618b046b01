// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A lens that zooms while the camera moves: what the images have grown by over the last ten frames, beyond
// what poses and map explain, and the translation that this feigns.
#include <cmath>
#include <deque>
#include <limits>

#include "edgevo/alignment/image_zoom.h"
#include "edgevo/core/motion_tolerance.h"

namespace edgevo {

/// Change of the size of the images, and the motion that it feigns.
struct FeignedMotion {
  /// Change of the size over the frames, as a share; NaN: unknown.
  double zoom = std::numeric_limits<double>::quiet_NaN();
  /// Translation that it feigns and its standard deviation, median depths.
  double depths = std::numeric_limits<double>::quiet_NaN(), sigma = std::numeric_limits<double>::quiet_NaN();
};

/// Compares sizes over ten frames; for the tracking thread.
class ZoomChange {
 public:
  /// Adds a frame that has a pose; compares over as many frames as there are.
  FeignedMotion add(const ImageZoom& newest) {
    frames_.push_back(newest);
    if (frames_.size() > size_t(kMotionTolerance.frames) + 1) frames_.pop_front();
    const ImageZoom& before = frames_.front();
    if (frames_.size() == 1) return {};
    const double zoom = newest.share - before.share;
    return {zoom, newest.feigned_depths * zoom,
            newest.feigned_depths * std::hypot(newest.sigma, before.sigma)};
  }
  /// A frame has no pose, or a new map begins.
  void interrupt() { frames_.clear(); }

 private:
  std::deque<ImageZoom> frames_;  // up to ten before the newest one, oldest first
};

}  // namespace edgevo
