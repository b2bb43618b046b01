// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/ground_links.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "moved_height.h"

namespace edgevo {
namespace {

// Of an epoch, nearest to its end: enough for the two per cent to which a road is even.
constexpr size_t kMaxKeyframes = 100;
// Of the median depth: less is the noise of a camera that stands.
constexpr double kNoMotion = 1e-3;

}  // namespace

GroundLinks::GroundLinks(const Pinhole& pinhole, const std::optional<SE3>& T_vehicle_cam,
                         const ScaleParams& params, std::shared_ptr<MapLog> log)
    : pinhole_(pinhole), down_(down_in_camera(T_vehicle_cam)), params_(params), log_(std::move(log)) {}

void GroundLinks::apply(const MapEvent& event) {
  std::visit([this](const auto& e) { handle(e); }, event);
}

// ---- epochs ----

void GroundLinks::handle(const SegmentPlaced& e) {
  if (!parts_.empty() && parts_.back().segment == e.segment) return;
  if (!parts_.empty()) measure_end(&parts_.back());
  parts_.emplace_back();
  parts_.back().segment = e.segment;
  path_.clear();
  window_ = {};
}

// The keyframes of the doubt belong to neither.
void GroundLinks::handle(const EpochBegan& e) {
  Part* const before = part_of(e.segment, e.last_before);
  if (!before) return;
  // Of a doubt that was evaluated when the next map had begun both units are in what was measured.
  if (before != &parts_.back()) return forget_height(before);
  Part now;
  now.segment = e.segment, now.first_keyframe = e.first;
  const auto is_before = [&](const Seen& k) { return k.id <= e.last_before; };
  const auto end = std::partition_point(before->keyframes.begin(), before->keyframes.end(), is_before);
  const auto begin =
      std::partition_point(end, before->keyframes.end(), [&](const Seen& k) { return k.id < e.first; });
  now.keyframes.assign(begin, before->keyframes.end());
  before->keyframes.erase(end, before->keyframes.end());
  measure_end(before);
  parts_.push_back(std::move(now));
}

GroundLinks::Part* GroundLinks::part_of(int segment, int keyframe_id) {
  const auto part = std::find_if(parts_.rbegin(), parts_.rend(), [&](const Part& p) {
    return p.segment == segment && p.first_keyframe <= keyframe_id;
  });
  return part == parts_.rend() ? nullptr : &*part;
}

// ---- what was seen ----

// A pose that shows no motion; that of a keyframe is needed nevertheless.
bool GroundLinks::stands(const FrameAnchored& e) const {
  const Eigen::Vector3d step =
      e.anchor->T_cam_map.inverse().translation() - path_.back().T_world_cam.translation();
  return e.frame.keyframe_reason == KeyframeReason::kNone &&
         step.norm() < kNoMotion * e.frame.evidence.median_depth;
}

void GroundLinks::handle(const FrameAnchored& e) {
  if (!e.anchor || parts_.empty() || e.frame.segment != parts_.back().segment) return;
  if (!path_.empty() && (e.frame.index <= path_.back().frame_index || stands(e))) return;
  extend(e.frame.index, e.frame.time, e.anchor->T_cam_map.inverse(), &path_);
}

void GroundLinks::handle(const KeyframeMarginalised& e) {
  if (parts_.empty() || e.keyframe->segment != parts_.back().segment || e.keyframe->is_doubtful) return;
  std::deque<Seen>& keyframes = parts_.back().keyframes;
  keyframes.push_back({e.id, e.keyframe, 1});
  ++parts_.back().marginalised;
  if (keyframes.size() > kMaxKeyframes) {
    keyframes.pop_front();
    const int first = keyframes.front().record->frame_index;
    path_.erase(path_.begin(), std::find_if(path_.begin(), path_.end(),
                                            [first](const PathPose& p) { return p.frame_index >= first; }));
  }
  link_newest();
}

void GroundLinks::handle(const WindowAdjusted& e) {
  window_ = e;
  link_newest();
}

void GroundLinks::handle(const MapMoved& e) {
  if (parts_.empty() || e.segment != parts_.back().segment) return;
  for (Seen& k : parts_.back().keyframes)
    if (const KeyframeMove* move = e.find(k.id)) k.height_ratio *= height_ratio(e, *move);
  for (Part& part : parts_)
    if (const KeyframeMove* move = e.find(part.last_keyframe);
        move && part.height && part.segment == e.segment)
      part.height->factor /= height_ratio(e, *move);
}

// With those of the window, as they are now.
std::vector<GroundLinks::Seen> GroundLinks::seen_in(const Part& part) const {
  std::vector<Seen> seen(part.keyframes.begin(), part.keyframes.end());
  if (!window_.keyframes) return seen;
  for (const WindowAdjusted::Active& k : *window_.keyframes)
    if (k.keyframe.segment == part.segment && !k.keyframe.is_doubtful && k.id >= part.first_keyframe &&
        (seen.empty() || k.id > seen.back().id))
      seen.push_back({k.id, {window_.keyframes, &k.keyframe}, 1});
  return seen;
}

// ---- heights ----

std::optional<ScaleEstimate> GroundLinks::measure(const std::vector<Seen>& keyframes) const {
  std::vector<HeightSample> heights;
  for (const Seen& k : keyframes)
    for (HeightSample height : ground_heights(pinhole_, *k.record, down_, path_, true, params_)) {
      height.height *= k.height_ratio;
      heights.push_back(height);
    }
  return fit_height(heights, 1.0, params_);
}

// From those that have left the window: it may show what lies beyond the end.
void GroundLinks::measure_end(Part* part) const {
  const std::vector<Seen> marginalised(part->keyframes.begin(), part->keyframes.end());
  if (marginalised.empty()) return;
  part->height = measure(marginalised);
  part->last_keyframe = marginalised.back().id;
  part->keyframes.clear();
}

// To the last epoch before it that shows ground; again each time that twice as much has been seen of it.
void GroundLinks::link_newest() {
  const auto before = std::find_if(parts_.rbegin(), parts_.rend(), [](const Part& p) { return p.height; });
  if (before == parts_.rend()) return;
  Part& now = parts_.back();
  const std::vector<Seen> seen = seen_in(now);
  const size_t keyframes = now.marginalised + seen.size() - now.keyframes.size();
  if (seen.empty() || keyframes < now.due) return;
  now.due = 2 * keyframes;
  const std::optional<ScaleEstimate> height = measure(seen);
  if (!height) return;
  const std::optional<int> earlier = now.constraint;
  now.constraint = log_->add_constraint(scale_constraint(
      ConstraintKind::kGround, NodeId::keyframe(before->last_keyframe), NodeId::keyframe(seen.back().id),
      height->factor / before->height->factor, std::hypot(height->sigma, before->height->sigma)));
  if (earlier) log_->withdraw_constraint(*earlier);
}

// With what rests on it.
void GroundLinks::forget_height(Part* part) {
  part->height.reset();
  std::optional<int>& newest = parts_.back().constraint;
  if (newest) log_->withdraw_constraint(*newest);
  newest.reset();
}

}  // namespace edgevo
