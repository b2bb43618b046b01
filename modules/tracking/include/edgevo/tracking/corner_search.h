// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Corners next to the frames. To find and follow them takes 30 ms and more, in one frame of fifty. On a
// schedule such a frame is answered with the pose of its edges; the map, which a wrong pose would bend, gets
// the pose with corners.
#include <future>
#include <memory>
#include <optional>

#include "edgevo/mapping/mapper.h"
#include "edgevo/tracking/frame_tracker.h"

namespace edgevo {

/// A frame that calls for corners, with all that its tracking knew.
struct CornerJob {
  /// Edge pyramid of the frame.
  std::shared_ptr<const FramePyramid> pyramid;
  /// What the frame was tracked against.
  std::shared_ptr<const Reference> reference;
  /// Motion model before the frame.
  MotionModel motion;
  /// Median step before the frame, where known.
  std::optional<MedianMotion::Step> median_step;
  /// Keyframe policy before the frame.
  KeyframePolicy keyframes;
  /// How the rows of the frame's image were rectified.
  RowRectification rows;
  /// Pose by the edges.
  PoseCandidate by_edges;
  /// Motion that the rows are rectified for in the end; corners are shifted to there.
  ImageMotion measured = {};
};

/// Searches corners in a thread of its own, of one frame at a time; for the tracking thread.
class CornerSearch {
 public:
  /// `seed`: that of the run.
  CornerSearch(const TrackingParams& params, uint64_t seed);

  /// Whether a search is under way.
  bool is_busy() const;
  /// Begins a search; not while another one is under way.
  std::shared_future<PoseByCorners> begin(CornerJob job);

 private:
  PoseByCorners search(const CornerJob& job);

  TrackingParams params_;
  Random random_;                            // of the search that is under way
  std::shared_future<PoseByCorners> found_;  // last member: it ends before the others
};

}  // namespace edgevo
