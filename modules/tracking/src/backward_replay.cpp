// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/backward_replay.h"

#include <utility>

#include "edgevo/alignment/tracker.h"
#include "edgevo/confidence/collect_evidence.h"
#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/trace.h"
#include "edgevo/tracking/bootstrap_placement.h"

namespace edgevo {
namespace {

// Views; and with their edges while nothing may be fixed to the camera and it has not stood: the others keep
// their image, a tenth of the memory.
constexpr size_t kMaxViews = 60, kMaxWithEdges = 16;

std::shared_ptr<const FramePyramid> without_levels(const FramePyramid& frame) {
  auto image = std::make_shared<FramePyramid>();
  image->source = frame.source;
  image->border_mask = frame.border_mask, image->ego_mask = frame.ego_mask;
  image->probability = frame.probability;
  image->correction = frame.correction;
  return image;
}

}  // namespace

void BackwardReplay::add(const ArrivedFrame& now) {
  const bool stands = !now.still.empty() && now.still.is_certain;
  is_needed_ |= stands;
  if (!stands || frames_.empty() || !frames_.back().stands)
    frames_.push_back({{}, stands, 0, now.pyramid, {}});
  Early& view = frames_.back();
  view.frames.push_back(now.frame.index);
  view.time = now.frame.time;
  if (!stands || now.still.show_it()) view.shown = view.frames.size(), view.pyramid = now.pyramid;
  if (frames_.size() > kMaxViews) frames_.pop_front();
  if (is_needed_ || now.may_show_ego_part || frames_.size() <= kMaxWithEdges) return;
  Early& old = frames_[frames_.size() - 1 - kMaxWithEdges];
  if (!old.pyramid->levels.empty()) old.pyramid = without_levels(*old.pyramid);
}

void BackwardReplay::look_again(
    const std::function<std::shared_ptr<const FramePyramid>(const std::shared_ptr<const FramePyramid>&)>&
        mask) {
  is_mask_another_ = false;
  for (Early& view : frames_) view.pyramid = mask(view.pyramid);
}

std::vector<EarlyView> BackwardReplay::views() const {
  std::vector<EarlyView> views;
  for (size_t i = 0; i + 1 < frames_.size(); ++i) {
    const Early& view = frames_[i];
    if (view.stands) views.clear();
    if (!view.stands) views.push_back({view.frames.back(), view.time, view.pyramid});
  }
  return views;
}

void BackwardReplay::place(const BootstrapResult& views, const Reference& reference, int segment,
                           const TrackingParams& params, FrameLog* frames) {
  std::deque<Early> early = std::exchange(frames_, {});
  is_mask_another_ = false;
  if (!std::exchange(is_needed_, false) || views.views.size() < 2) return;
  const TraceScope traced("poses of earlier frames");
  const SupportScorer scorer(params.status);
  SE3 later = pose_in_map(views.views[1], views, reference),
      last = pose_in_map(views.views.front(), views, reference);
  while (!early.empty()) {
    const Early view = std::move(early.back());
    early.pop_back();
    if (view.frames.front() >= views.views.front().frame_index) continue;
    if (view.shown < view.frames.size()) return;  // it drove off unseen: no steps lead there
    const TrackResult found =
        track(*view.pyramid, reference.cloud, motion_hypotheses(last, last * later.inverse()), scorer,
              params.alignment);
    for (auto i = view.frames.rbegin(); i != view.frames.rend(); ++i) {
      if (*i >= views.views.front().frame_index) continue;
      std::optional<FrameRecord> record = frames->find(*i);
      if (!record || record->T_world_cam_live) return;
      add_pose(found, reference, &record->evidence);
      record->evidence.stands |= view.stands;
      const TrackingState state = frame_status(record->evidence, params.status).state;
      if (state == TrackingState::kLost) return;
      assign_status({state, {}}, &*record);
      record->covariance = reported_covariance(found, reference);
      frames->place(std::move(*record), segment, reference, found.T_cur_ref);
    }
    later = std::exchange(last, found.T_cur_ref);
  }
}

void BackwardReplay::clear() {
  frames_.clear();
  is_needed_ = is_mask_another_ = false;
}

}  // namespace edgevo
