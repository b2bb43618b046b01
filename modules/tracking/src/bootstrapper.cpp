// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/bootstrapper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edgevo/core/trace.h"
#include "edgevo/map/segment_join.h"

namespace edgevo {

Bootstrapper::Bootstrapper(const Rectification& rectification, const TrackingParams& params,
                           const BootstrapParams& bootstrap, uint64_t seed, MapLink* map, FrameLog* frames,
                           TurnBetween turn)
    : pinhole_(rectification.target()),
      bootstrap_(rectification, bootstrap, seed,
                 [this](Timestamp a, Timestamp b) { return turn_between(a, b); }),
      params_(params),
      map_(map),
      frames_(frames),
      turn_(std::move(turn)) {}

BootstrapStatus Bootstrapper::add(const ArrivedFrame& now) {
  return bootstrap_.add(now.frame.index, now.frame.time, now.pyramid, true, now.rows.expected);
}

void Bootstrapper::begin_with(const std::vector<EarlyView>& views) {
  const auto add = [&](const EarlyView& v, bool attempt) {
    return bootstrap_.add(v.frame_index, v.time, v.pyramid, attempt);
  };
  size_t needed = views.size();
  bootstrap_.reset();
  for (const EarlyView& v : views)
    if (const BootstrapStatus status = add(v, true); status.result) {
      needed = status.result->views.size();
      break;
    }
  bootstrap_.reset();
  for (size_t i = views.size() - needed; i < views.size(); ++i) (void)add(views[i], false);
}

std::optional<CameraTurn> Bootstrapper::turn_between(Timestamp begin, Timestamp end) const {
  if (turn_)
    if (const std::optional<CameraTurn> turn = turn_(begin, end)) return turn;
  return located_.turn_between(begin, end);
}

Reasons Bootstrapper::make_map(const BootstrapResult& views) {
  Reasons problem = map_->make_map(views);
  bootstrap_.reset();
  return problem;
}

SegmentPlaced Bootstrapper::place(int segment, const BootstrapResult& views,
                                  const std::optional<TrustedReference>& before,
                                  const std::optional<ViewLink>& link, std::optional<double> scale) const {
  if (before && link)
    return link_segment(segment, *before->reference, frames_->T_odom_map(before->segment), *map_->reference(),
                        {link->T_b_a, link->scale, link->sigma});
  if (const auto located = located_.place(segment, views)) return *located;
  const std::vector<TimedPose> previous =
      frames_->run().last_poses(segment - 1, views.views.front().frame_index, kJoinPoses);
  const std::vector<TimedPose> sure =
      frames_->run().last_trusted_poses(segment - 1, views.views.front().frame_index, kJoinPoses);
  const BootstrapView &first = views.views.front(), &last = views.views.back();
  MapBeginning beginning{first.time, last.time, last.T_cam_first, std::nullopt};
  if (turn_ && !previous.empty())
    if (const std::optional<CameraTurn> turn = turn_(previous.back().time, first.time))
      beginning.turn = {turn->R, std::sqrt(turn->covariance.trace() / 3)};
  return join_segment(segment, previous, sure, beginning, scale);
}

NewSegment Bootstrapper::begin_segment(int segment, const BootstrapResult& views,
                                       const std::optional<TrustedReference>& before,
                                       std::optional<double> scale, const SegmentBeginning* known) {
  const std::optional<ViewLink> link = known ? known->link : find_link(pinhole_, before, *map_->reference());
  const SegmentPlaced placed = place(segment, views, before, link, scale);
  frames_->begin_segment(placed);
  map_->begin_segment(segment);
  if (before && link)
    frames_->add_constraint(
        constraint_of({link->T_b_a, link->scale, link->sigma}, *before->reference, *map_->reference()));
  if (located_.clear())
    frames_->add_constraint(place_of(map_->reference()->keyframe_id, map_->reference()->T_ref_world, placed));
  NewSegment begun;
  begun.reference = map_->reference();
  begun.why = views.why;
  const TraceScope traced("poses of the bootstrap");
  place_bootstrap_frames(views,
                         known ? known->tracks : track_bootstrap_frames(views, *begun.reference, params_),
                         *begun.reference, segment, params_, frames_);
  const std::optional<SE3> earlier = frames_->run().pose_before(views.views.back().frame_index, segment);
  if (earlier) begun.motion = begun.reference->T_ref_world * earlier->inverse();
  return begun;
}

}  // namespace edgevo
