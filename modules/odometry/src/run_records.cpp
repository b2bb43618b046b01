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
  Hook hook{keyframe_id, map_.revision(), T_cam_ref, T_cam_ref * T_ref_map};
  record->segment = segment;
  record->T_world_cam_live = T_world_map_[segment].apply(hook.T_cam_map_live.inverse());
  hooks_[record->index] = hook;
}

std::optional<SE3> RunRecords::pose_before(int frame_index, int segment) const {
  auto it = hooks_.lower_bound(frame_index);
  if (it == hooks_.begin()) return std::nullopt;
  --it;
  if (frames_[position_.at(it->first)].segment != segment) return std::nullopt;
  return it->second.T_cam_map_live;
}

SettledKeyframes RunRecords::settled(size_t skip) const {
  SettledKeyframes settled = map_.settled(skip);
  for (KeyframeRecord& k : settled.keyframes) move_to_world(T_world_map_[size_t(k.segment)], &k);
  return settled;
}

std::optional<UnsettledKeyframes> RunRecords::unsettled(int version) const {
  std::optional<UnsettledKeyframes> unsettled = map_.unsettled(version);
  if (unsettled)
    for (KeyframeRecord& k : unsettled->keyframes) move_to_world(T_world_map_[size_t(k.segment)], &k);
  return unsettled;
}

// The frame of a keyframe stands where the keyframe does: its pose was adjusted, while the one it was tracked
// with was not.
void RunRecords::hang_on_itself(int keyframe_id, const KeyframeRecord& keyframe) {
  FrameRecord* frame = find(keyframe.frame_index);
  if (!frame) return;
  frame->is_keyframe = true;
  if (frame->keyframe_reason == KeyframeReason::kNone) frame->keyframe_reason = KeyframeReason::kBootstrap;
  const auto hook = hooks_.find(keyframe.frame_index);
  if (hook == hooks_.end() || frame->segment != keyframe.segment) return;
  hook->second.keyframe_id = keyframe_id;
  hook->second.T_cam_ref = SE3();
}

// The final pose of a frame, from that of its keyframe.
void RunRecords::finish_frame(const MapRecords::Everything& map,
                              const std::map<int, int>& position_of_keyframe,
                              const std::vector<KeyframeRecord>& keyframes, FrameRecord* frame) const {
  const auto hook = hooks_.find(frame->index);
  if (hook == hooks_.end()) return;
  const auto& [keyframe_id, revision, T_cam_ref, T_cam_map_live] = hook->second;
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
    hang_on_itself(id, keyframe);
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
