#include "run_records.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/record_units.h"

namespace edgevo {
namespace {

KeyframeRecord to_record(const Keyframe& k, int segment) {
  KeyframeRecord record;
  record.frame_index = k.frame_index;
  record.time = k.time;
  record.segment = segment;
  record.T_world_cam = k.T_cam_world.inverse();
  record.points.reserve(k.points.size());
  const ImageView<uint8_t> gray = k.pyramid->finest().gray.view();
  for (const MapPoint& p : k.points) {
    EdgePoint e;
    e.px = p.px.cast<float>();
    e.normal = p.normal.cast<float>();
    e.idepth = float(p.idepth);
    e.idepth_sigma = float(p.idepth_sigma);
    e.observations = int(p.observations.size());
    e.gray = gray.at(int(std::lround(e.px.x())), int(std::lround(e.px.y())));
    record.points.push_back(e);
  }
  return record;
}

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
  Hook hook{keyframe_id, current_revision(), T_cam_ref, T_cam_ref * T_ref_map};
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

void RunRecords::note_mapping(int frame_index, const MapUpdate& update) {
  const std::lock_guard<std::mutex> lock(mutex_);
  mapping_times_[frame_index] = update.times;
}

int RunRecords::current_revision() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return revision_;
}

void RunRecords::retire(std::vector<Keyframe> keyframes, int segment) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Keyframe& k : keyframes) {
    keyframes_[k.id] = to_record(k, segment);
    retired_.push_back(k.id);
  }
}

void RunRecords::set_lines(std::vector<HostedLines> hosted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (HostedLines& h : hosted) keyframes_.at(h.keyframe_id).lines = std::move(h.lines);
}

SettledKeyframes RunRecords::settled(size_t skip) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  SettledKeyframes settled;
  settled.revision = revision_;
  for (size_t i = skip; i < retired_.size(); ++i) {
    settled.keyframes.push_back(keyframes_.at(retired_[i]));
    move_to_world(T_world_map_[size_t(settled.keyframes.back().segment)], &settled.keyframes.back());
  }
  return settled;
}

void RunRecords::note_window(const std::deque<Keyframe>& keyframes, int segment) {
  std::vector<KeyframeRecord> records;
  for (const Keyframe& k : keyframes) records.push_back(to_record(k, segment));
  const std::lock_guard<std::mutex> lock(mutex_);
  window_.revision = revision_;
  ++window_.version;
  window_.keyframes = std::move(records);
}

std::optional<UnsettledKeyframes> RunRecords::unsettled(int version) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (window_.version == version) return std::nullopt;
  UnsettledKeyframes unsettled = window_;
  for (KeyframeRecord& k : unsettled.keyframes) move_to_world(T_world_map_[size_t(k.segment)], &k);
  return unsettled;
}

void RunRecords::revise(std::vector<RevisedKeyframe> keyframes) {
  if (keyframes.empty()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  ++revision_;
  for (const RevisedKeyframe& r : keyframes) {
    length_ratio_[r.id].emplace_back(revision_, r.length_ratio);
    const auto known = keyframes_.find(r.id);
    if (known == keyframes_.end()) continue;  // still in the window: it retires with its new values
    KeyframeRecord& k = known->second;
    k.T_world_cam = r.T_cam_world.inverse();
    for (size_t i = 0; i < k.points.size(); ++i) {
      EdgePoint& p = k.points[i];
      p.px = r.points[i].px.cast<float>();
      // Not by the ratio of the two depths: a point that moves out to infinity is no more certain for it.
      p.idepth_sigma /= float(r.length_ratio);
      p.idepth = float(r.points[i].idepth);
    }
  }
}

// How much the unit of length near a keyframe has changed since a revision.
double RunRecords::length_ratio_since(int keyframe_id, int revision) const {
  const auto known = length_ratio_.find(keyframe_id);
  double ratio = 1;
  if (known != length_ratio_.end())
    for (const auto& [number, value] : known->second)
      if (number > revision) ratio *= value;
  return ratio;
}

// The frame of a keyframe stands where the keyframe does: its pose was adjusted, while the one it was tracked
// with was not.
void RunRecords::hang_on_itself(int keyframe_id, const KeyframeRecord& keyframe) {
  FrameRecord* frame = find(keyframe.frame_index);
  if (!frame) return;
  frame->is_keyframe = true;
  if (frame->keyframe_rule.empty()) frame->keyframe_rule = "bootstrap";
  const auto hook = hooks_.find(keyframe.frame_index);
  if (hook == hooks_.end() || frame->segment != keyframe.segment) return;
  hook->second.keyframe_id = keyframe_id;
  hook->second.T_cam_ref = SE3();
}

Run RunRecords::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  Run run;
  run.pinhole = pinhole_;
  std::map<int, int> position;  // keyframe id -> run.keyframes
  for (auto& [id, keyframe] : keyframes_) {
    move_to_world(T_world_map_[keyframe.segment], &keyframe);
    position[id] = int(run.keyframes.size());
    hang_on_itself(id, keyframe);
    run.keyframes.push_back(std::move(keyframe));
  }
  for (FrameRecord& frame : frames_) {
    const auto times = mapping_times_.find(frame.index);
    if (times != mapping_times_.end())
      frame.stage_ms.insert(frame.stage_ms.end(), times->second.begin(), times->second.end());
    const auto hook = hooks_.find(frame.index);
    if (hook == hooks_.end()) continue;
    const Sim3& T_world_map = T_world_map_[frame.segment];
    const double length =
        T_world_map.scale * length_ratio_since(hook->second.keyframe_id, hook->second.revision);
    Vector6d unit = Vector6d::Ones();
    unit.head<3>().setConstant(length);
    frame.covariance = unit.asDiagonal() * frame.covariance * unit.asDiagonal();
    const auto keyframe = position.find(hook->second.keyframe_id);
    if (keyframe == position.end()) continue;
    frame.reference_keyframe = keyframe->second;
    const SE3 T_ref_cam = hook->second.T_cam_ref.inverse();
    const SE3 T_ref_cam_scaled(T_ref_cam.rotation(), length * T_ref_cam.translation());
    frame.T_world_cam = run.keyframes[keyframe->second].T_world_cam * T_ref_cam_scaled;
  }
  run.frames.assign(std::make_move_iterator(frames_.begin()), std::make_move_iterator(frames_.end()));
  if (revision_ > 0) move_first_to_origin(&run);
  return run;
}

}  // namespace edgevo
