// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frames that came before a map could be made: while a camera stands, or before it was known what in view is
// fixed to it (their views make no map, since the part would be in it). The map that is made later gives them
// poses backwards.
#include <deque>
#include <memory>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/map/frame_log.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/tracking/front_end.h"
#include "edgevo/tracking/tracking_params.h"

namespace edgevo {

/// Keeps the frames of a bootstrap until there is a map; for the tracking thread.
class BackwardReplay {
 public:
  /// Takes the next frame without a pose. Beyond a bound, lower while nothing may be fixed to the camera and
  /// it has not stood, the oldest view is lost, with all frames that share it.
  void add(const ArrivedFrame& now);
  /// The frames so far will not be in the views of a map, as their mask is another or other views are better.
  void views_dropped() { is_needed_ = !frames_.empty(); }
  /// The map of a segment is there: gives the frames before its first view their poses, from the latest to
  /// the first that the map does not explain, and forgets all. Nothing happens if the camera did not stand
  /// and no views were dropped. Cost: one alignment a frame, one for all in which the camera stood.
  void place(const BootstrapResult& views, const Reference& reference, int segment,
             const TrackingParams& params, FrameLog* frames);
  /// Forgets the frames.
  void clear();

 private:
  // Frames that share a pose, since the camera stands, by their indices; the edges of the last one that shows
  // it, and the number of frames up to that: the camera may drive off behind what hides the view.
  struct Early {
    std::vector<int> frames;
    bool stands;
    size_t shown;
    std::shared_ptr<const FramePyramid> pyramid;
  };
  std::deque<Early> frames_;
  bool is_needed_ = false;
};

}  // namespace edgevo
