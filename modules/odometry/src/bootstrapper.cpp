// SPDX-License-Identifier: BSD-3-Clause
#include "bootstrapper.h"

#include "bootstrap_placement.h"
#include "segment_join.h"

namespace edgevo {

Bootstrapper::Bootstrapper(const Pinhole& pinhole, const OdometryParams& params, uint64_t seed, MapLink* map,
                           FrameLog* frames)
    : bootstrap_(pinhole, params.mapping.bootstrap, seed), params_(params), map_(map), frames_(frames) {}

BootstrapStatus Bootstrapper::add(const ArrivedFrame& now) {
  return bootstrap_.add(now.frame.index, now.frame.time, now.pyramid);
}

std::string Bootstrapper::make_map(const BootstrapResult& views) {
  const std::string problem = map_->make_map(views);
  bootstrap_.reset();
  return problem;
}

NewSegment Bootstrapper::begin_segment(int segment, const BootstrapResult& views,
                                       std::optional<double> scale) {
  const std::vector<TimedPose> previous =
      frames_->run().last_poses(segment - 1, views.views.front().frame_index, kJoinPoses);
  const std::vector<TimedPose> sure =
      frames_->run().last_sure_poses(segment - 1, views.views.front().frame_index, kJoinPoses);
  frames_->begin_segment(join_segment(segment, previous, sure, views, scale));
  map_->begin_segment(segment);
  NewSegment begun;
  begun.reference = map_->reference();
  place_bootstrap_frames(views, *begun.reference, segment, params_, frames_);
  const std::optional<SE3> before = frames_->run().pose_before(views.views.back().frame_index, segment);
  if (before) begun.motion = begun.reference->T_ref_world * before->inverse();
  return begun;
}

}  // namespace edgevo
