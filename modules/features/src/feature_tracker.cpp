// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/feature_tracker.h"

#include "corner_evaluation.h"
#include "corner_tracks.h"

namespace edgevo {

struct FeatureTracker::Impl {
  CornerTracks tracks;
  CornerEvaluation evaluation;
};

FeatureTracker::FeatureTracker() : impl_(std::make_unique<Impl>()) {}
FeatureTracker::~FeatureTracker() = default;
FeatureTracker::FeatureTracker(FeatureTracker&&) noexcept = default;

std::optional<CornerEvidence> FeatureTracker::add(const std::shared_ptr<const FramePyramid>& frame,
                                                  const std::optional<SE3>& T_cur_last,
                                                  const MovesByItself& moves, bool stands,
                                                  const std::optional<SE3>& T_cam_map) {
  CornerTracks& tracks = impl_->tracks;
  CornerEvaluation& evaluation = impl_->evaluation;
  evaluation.change_lens(frame->correction);
  tracks.follow(frame, evaluation.expect(T_cur_last));
  if (stands) tracks.drop_moving();
  if (moves) tracks.drop_where(moves);
  const std::optional<CornerEvidence> evidence = evaluation.add(tracks.view(), T_cur_last, T_cam_map);
  tracks.drop(evaluation.take_rejected());
  return evidence;
}

std::vector<FollowedCorner> FeatureTracker::followed() const { return impl_->tracks.followed(); }

void FeatureTracker::begin_map(double median_idepth) { impl_->evaluation.begin_map(median_idepth); }

}  // namespace edgevo
