// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/bootstrapper.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
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

std::optional<CameraTurn> Bootstrapper::turn_between(Timestamp begin, Timestamp end) const {
  if (turn_)
    if (const std::optional<CameraTurn> turn = turn_(begin, end)) return turn;
  const auto at = [&](Timestamp time) {
    return std::find_if(located_.begin(), located_.end(),
                        [&](const auto& l) { return l.second.time == time; });
  };
  const auto a = at(begin), b = at(end);
  if (a == located_.end() || b == located_.end()) return std::nullopt;
  const LocatedPose &first = a->second.pose, &last = b->second.pose;
  const Eigen::Quaterniond R = (last.T_world_cam.inverse() * first.T_world_cam).rotation();
  const Eigen::Matrix3d of_first = first.covariance.bottomRightCorner<3, 3>();
  return CameraTurn{R, R.toRotationMatrix() * of_first * R.toRotationMatrix().transpose() +
                           last.covariance.bottomRightCorner<3, 3>()};
}

Reasons Bootstrapper::make_map(const BootstrapResult& views) {
  Reasons problem = map_->make_map(views);
  bootstrap_.reset();
  return problem;
}

// By the view that was located, or that is nearest to a frame that was: the newest of them.
std::optional<SegmentPlaced> Bootstrapper::place_located(int segment, const BootstrapResult& views) const {
  const auto distance = [](const auto& a, const BootstrapView& b) {
    return std::abs(a.first - b.frame_index);
  };
  // What a camera moves its view by from one frame to the next, radians.
  constexpr double kMoves = 0.025;
  std::optional<SegmentPlaced> placed;
  int nearest = std::numeric_limits<int>::max();
  for (const auto& located : located_)
    for (const BootstrapView& view : views.views)
      if (view.placed && distance(located, view) <= nearest) {
        nearest = distance(located, view);
        placed = locate_segment(segment, located.second.pose, view.T_cam_first, kFirstMedianDepth);
      }
  if (!placed || nearest == 0) return placed;
  placed->method = SegmentPlaced::Method::kDepthRatio;  // a guess
  placed->position_sigma += nearest * kMoves * kFirstMedianDepth * placed->T_world_map.scale;
  placed->rotation_sigma += nearest * kMoves;
  return placed;
}

SegmentPlaced Bootstrapper::place(int segment, const BootstrapResult& views,
                                  const std::optional<TrustedReference>& before,
                                  const std::optional<ViewLink>& link, std::optional<double> scale) const {
  if (before && link)
    return link_segment(segment, *before->reference, frames_->T_odom_map(before->segment), *map_->reference(),
                        {link->T_b_a, link->scale, link->sigma});
  if (const auto located = place_located(segment, views)) return *located;
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
  if (!std::exchange(located_, {}).empty())
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
