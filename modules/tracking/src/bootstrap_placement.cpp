// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/bootstrap_placement.h"

#include <utility>

#include "edgevo/confidence/collect_evidence.h"
#include "edgevo/confidence/frame_status.h"

namespace edgevo {
namespace {

bool is_keyframe(const BootstrapView& view, const BootstrapResult& bootstrap) {
  return view.frame_index == bootstrap.views.front().frame_index ||
         view.frame_index == bootstrap.views.back().frame_index;
}

}  // namespace

SE3 pose_in_map(const BootstrapView& view, const BootstrapResult& bootstrap, const Reference& reference) {
  if (view.frame_index == bootstrap.views.back().frame_index) return SE3();
  const bool is_first = view.frame_index == bootstrap.views.front().frame_index;
  return (is_first ? reference.T_keyframe_world.begin()->second : view.T_cam_first) *
         reference.T_ref_world.inverse();
}

BootstrapTracks track_bootstrap_frames(const BootstrapResult& bootstrap, const Reference& reference,
                                       const TrackingParams& params) {
  const SupportScorer scorer(params.status);
  BootstrapTracks tracks;
  for (const BootstrapView& view : bootstrap.views) {
    tracks.emplace_back();
    if (!view.placed || !view.pyramid) continue;
    tracks.back() = track(*view.pyramid, reference.cloud, {pose_in_map(view, bootstrap, reference)}, scorer,
                          params.alignment);
  }
  return tracks;
}

void place_bootstrap_frames(const BootstrapResult& bootstrap, const BootstrapTracks& tracks,
                            const Reference& reference, int segment, const TrackingParams& params,
                            FrameLog* frames) {
  for (size_t i = 0; i < bootstrap.views.size(); ++i) {
    const BootstrapView& view = bootstrap.views[i];
    std::optional<FrameRecord> record = frames->find(view.frame_index);
    if (!record || !view.placed) continue;
    SE3 T_cam_ref = pose_in_map(view, bootstrap, reference);
    record->covariance.setZero();  // a frame that was located had one in another unit
    std::optional<FrameStatus> status;
    if (tracks[i]) {
      const TrackResult& r = *tracks[i];
      add_pose(r, reference, &record->evidence);
      status = frame_status(record->evidence, params.status);
      if (status->state != TrackingState::kLost && !is_keyframe(view, bootstrap))
        T_cam_ref = r.T_cur_ref, record->covariance = reported_covariance(r, reference);
    }
    assign_status(status_of_bootstrap_frame(status), &*record);
    frames->place(std::move(*record), segment, reference, T_cam_ref);
  }
}

}  // namespace edgevo
