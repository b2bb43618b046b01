// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frames that came before a map could be made: while a camera stands, or before it was known what in view is
// fixed to it (a map of them would have the part in it). They are seen again without the part, as views of a
// map; a map that is made of later ones gives them poses backwards.
#include <deque>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/map/frame_log.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/tracking/front_end.h"
#include "edgevo/tracking/tracking_params.h"

namespace edgevo {

/// A frame that may be a view of a map.
struct EarlyView {
  /// Its index.
  int frame_index;
  /// Its time.
  Timestamp time;
  /// Its edges.
  std::shared_ptr<const FramePyramid> pyramid;
};

/// Keeps the frames of a bootstrap until there is a map; for the tracking thread.
class BackwardReplay {
 public:
  /// Takes the next frame without a pose. Beyond a bound the oldest view is lost, with all frames that share
  /// it; beyond a lower one, while nothing may be fixed to the camera and it has not stood, only its image is
  /// kept.
  void add(const ArrivedFrame& now);
  /// The frames so far are not among the views of a map any more: other ones are better.
  void views_dropped() { is_needed_ = !frames_.empty(); }
  /// The same, as what is masked from now on is another area.
  void mask_changed() { views_dropped(), is_mask_another_ = !frames_.empty(); }
  /// Whether the mask is another one since look_again().
  bool is_mask_another() const { return is_mask_another_; }
  /// Whether a map that is made now gives earlier frames their poses (place()).
  bool is_needed() const { return is_needed_; }
  /// Takes the frames so far for what `mask` makes of each; of those kept as an image it makes a pyramid.
  /// To be called before place().
  void look_again(
      const std::function<std::shared_ptr<const FramePyramid>(const std::shared_ptr<const FramePyramid>&)>&
          mask);
  /// Those before the newest one, since the camera moves: views of a map.
  std::vector<EarlyView> views() const;
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
    Timestamp time;  // of the last one
  };
  std::deque<Early> frames_;
  bool is_needed_ = false, is_mask_another_ = false;
};

}  // namespace edgevo
