// SPDX-License-Identifier: BSD-3-Clause
#include "run_records.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "edgevo/core/record_units.h"

namespace edgevo {
namespace {

// From a segment's map to the world: lengths grow by the scale, inverse depths shrink.
void move_to_world(const Sim3& T_world_map, KeyframeRecord* k) {
  k->T_world_cam = T_world_map.apply(k->T_world_cam);
  multiply_depths(T_world_map.scale, k);
}

}  // namespace

RunRecords::RunRecords(const Pinhole& pinhole) : pinhole_(pinhole) {}

FrameRecord& RunRecords::begin_frame(const Frame& frame) {
  FrameRecord record;
  record.index = frame.index;
  record.time = frame.time;
  position_[frame.index] = frames_.size();
  frames_.push_back(std::move(record));
  return frames_.back();
}

FrameRecord* RunRecords::find(int frame_index) {
  const auto it = position_.find(frame_index);
  return it == position_.end() ? nullptr : &frames_[it->second];
}

std::vector<TimedPose> RunRecords::last_poses(int segment, int last_frame, size_t at_most) const {
  std::vector<TimedPose> poses;
  for (auto f = frames_.rbegin(); f != frames_.rend() && poses.size() < at_most; ++f)
    if (f->T_world_cam_live && f->segment == segment && f->index <= last_frame)
      poses.push_back({f->time, *f->T_world_cam_live});
  std::reverse(poses.begin(), poses.end());
  return poses;
}

void RunRecords::begin_segment(int segment, const Sim3& T_world_map) {
  T_world_map_.resize(size_t(segment) + 1);
  T_world_map_[size_t(segment)] = T_world_map;
}

void RunRecords::place(FrameRecord* record, int segment, int keyframe_id, const SE3& T_cam_ref,
                       const SE3& T_ref_map) {
  const FrameAnchor anchor{keyframe_id, map_.revision(), T_cam_ref, T_cam_ref * T_ref_map};
  record->segment = segment;
  record->T_world_cam_live = T_world_map_[segment].apply(anchor.T_cam_map_live.inverse());
  anchors_[record->index] = anchor;
}

std::optional<SE3> RunRecords::pose_before(int frame_index, int segment) const {
  auto it = anchors_.lower_bound(frame_index);
  if (it == anchors_.begin()) return std::nullopt;
  --it;
  if (frames_[position_.at(it->first)].segment != segment) return std::nullopt;
  return it->second.T_cam_map_live;
}

MarginalisedKeyframes RunRecords::marginalised(size_t first) const {
  MarginalisedKeyframes marginalised = map_.marginalised(first);
  for (KeyframeRecord& k : marginalised.keyframes) move_to_world(T_world_map_[size_t(k.segment)], &k);
  return marginalised;
}

std::optional<ActiveKeyframes> RunRecords::active(int version) const {
  std::optional<ActiveKeyframes> active = map_.active(version);
  if (active)
    for (KeyframeRecord& k : active->keyframes) move_to_world(T_world_map_[size_t(k.segment)], &k);
  return active;
}

// A keyframe's frame takes the final pose of the keyframe: that was adjusted, unlike the pose from tracking.
void RunRecords::anchor_to_own_keyframe(int keyframe_id, const KeyframeRecord& keyframe) {
  FrameRecord* frame = find(keyframe.frame_index);
  if (!frame) return;
  frame->is_keyframe = true;
  if (frame->keyframe_reason == KeyframeReason::kNone) frame->keyframe_reason = KeyframeReason::kBootstrap;
  const auto anchor = anchors_.find(keyframe.frame_index);
  if (anchor == anchors_.end() || frame->segment != keyframe.segment) return;
  anchor->second.keyframe_id = keyframe_id;
  anchor->second.T_cam_ref = SE3();
}

// Computes the final pose of a frame from that of its keyframe.
void RunRecords::finish_frame(const MapRecords::Everything& map,
                              const std::map<int, int>& position_of_keyframe,
                              const std::vector<KeyframeRecord>& keyframes, FrameRecord* frame) const {
  const auto anchor = anchors_.find(frame->index);
  if (anchor == anchors_.end()) return;
  const auto& [keyframe_id, revision, T_cam_ref, T_cam_map_live] = anchor->second;
  const double length =
      T_world_map_[size_t(frame->segment)].scale * map.length_ratio_since(keyframe_id, revision);
  Vector6d unit = Vector6d::Ones();
  unit.head<3>().setConstant(length);
  frame->covariance = unit.asDiagonal() * frame->covariance * unit.asDiagonal();
  const auto keyframe = position_of_keyframe.find(keyframe_id);
  if (keyframe == position_of_keyframe.end()) return;
  frame->reference_keyframe = keyframe->second;
  const SE3 T_ref_cam = T_cam_ref.inverse();
  const SE3 T_ref_cam_scaled(T_ref_cam.rotation(), length * T_ref_cam.translation());
  frame->T_world_cam = keyframes[size_t(keyframe->second)].T_world_cam * T_ref_cam_scaled;
}

Run RunRecords::finish() {
  MapRecords::Everything map = map_.take();
  Run run;
  run.pinhole = pinhole_;
  std::map<int, int> position_of_keyframe;  // in run.keyframes
  for (auto& [id, keyframe] : map.keyframes) {
    move_to_world(T_world_map_[size_t(keyframe.segment)], &keyframe);
    position_of_keyframe[id] = int(run.keyframes.size());
    anchor_to_own_keyframe(id, keyframe);
    run.keyframes.push_back(std::move(keyframe));
  }
  for (FrameRecord& frame : frames_) {
    const auto times = map.times.find(frame.index);
    if (times != map.times.end())
      frame.stage_ms.insert(frame.stage_ms.end(), times->second.begin(), times->second.end());
    finish_frame(map, position_of_keyframe, run.keyframes, &frame);
  }
  run.frames.assign(std::make_move_iterator(frames_.begin()), std::make_move_iterator(frames_.end()));
  if (map.revision > 0) move_first_to_origin(&run);
  return run;
}

}  // namespace edgevo
