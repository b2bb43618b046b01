// SPDX-License-Identifier: BSD-3-Clause
#include "propagate_keyframe_poses.h"

#include <algorithm>
#include <map>

#include "edgevo/core/record_units.h"

namespace edgevo {
namespace {

// A distance between keyframes that has doubled or halved did not change because of scale alone.
constexpr double kLongestRatio = 2;

// A keyframe, with its pose when its frame was processed and its final pose.
struct Anchor {
  int position;  // in Run::keyframes
  SE3 T_then, T_now;
};
using Anchors = std::map<int, Anchor>;  // by frame index

std::map<int, FrameRecord*> by_index(Run* run) {
  std::map<int, FrameRecord*> frames;
  for (FrameRecord& frame : run->frames) frames[frame.index] = &frame;
  return frames;
}

std::map<int, Anchors> anchors_by_segment(Run* run) {
  const std::map<int, FrameRecord*> frames = by_index(run);
  std::map<int, Anchors> segments;
  for (size_t i = 0; i < run->keyframes.size(); ++i) {
    const KeyframeRecord& k = run->keyframes[i];
    const auto frame = frames.find(k.frame_index);
    if (frame == frames.end()) continue;
    FrameRecord& f = *frame->second;
    f.is_keyframe = true;
    if (f.keyframe_reason == KeyframeReason::kNone) f.keyframe_reason = KeyframeReason::kBootstrap;
    segments[k.segment][k.frame_index] = {int(i), f.T_world_cam_live.value_or(k.T_world_cam), k.T_world_cam};
  }
  return segments;
}

// Ratio of the distance between two keyframes now to that when their frames were processed.
double length_ratio(const Anchor& a, const Anchor& b) {
  const double then = (b.T_then.translation() - a.T_then.translation()).norm();
  const double now = (b.T_now.translation() - a.T_now.translation()).norm();
  return then > 0 ? std::clamp(now / then, 1 / kLongestRatio, kLongestRatio) : 1;
}

// The last keyframe at or before the frame, or the first one.
Anchors::const_iterator anchor_of(const Anchors& anchors, int frame_index) {
  const auto after = anchors.upper_bound(frame_index);
  return after == anchors.begin() ? after : std::prev(after);
}

SE3 moved(const Anchors& anchors, Anchors::const_iterator anchor, const SE3& T_live) {
  const auto next = std::next(anchor) != anchors.end() ? std::next(anchor) : anchor;
  const auto before = next != anchor || anchor == anchors.begin() ? anchor : std::prev(anchor);
  const SE3 T_anchor_cam = anchor->second.T_then.inverse() * T_live;
  const double ratio = length_ratio(before->second, next->second);
  return anchor->second.T_now * SE3(T_anchor_cam.rotation(), ratio * T_anchor_cam.translation());
}

void propagate(const Anchors& anchors, FrameRecord* frame) {
  const auto anchor = anchor_of(anchors, frame->index);
  frame->reference_keyframe = anchor->second.position;
  if (anchor->first == frame->index)
    frame->T_world_cam = anchor->second.T_now;
  else if (frame->T_world_cam_live)
    frame->T_world_cam = moved(anchors, anchor, *frame->T_world_cam_live);
}

}  // namespace

void propagate_keyframe_poses(InterruptedRun* interrupted) {
  Run& run = interrupted->run;
  const std::map<int, Anchors> segments = anchors_by_segment(&run);
  for (FrameRecord& frame : run.frames) {
    const auto anchors = segments.find(frame.segment);
    if (anchors != segments.end())
      propagate(anchors->second, &frame);
    else
      frame.T_world_cam = frame.T_world_cam_live;
  }
  if (interrupted->camera_was_corrected) move_first_to_origin(&run);
}

}  // namespace edgevo
