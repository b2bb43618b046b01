// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/frame_log.h"

#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace edgevo {

FrameLog::FrameLog(const Rectification& rectification, std::shared_ptr<MapLog> log, bool own_thread)
    : log_(std::move(log)),
      cursor_(log_),
      run_(rectification),
      placer_(std::make_unique<Worker>(WorkerOptions{"map graph", 1, own_thread, true, true})) {
  newest_.frame.index = -1;
}

FrameRecord& FrameLog::begin_frame(const Frame& frame) {
  newest_ = {};
  newest_.frame.index = frame.index;
  newest_.frame.time = frame.time;
  return newest_.frame;
}

FrameRecord& FrameLog::repeat_frame(const Frame& frame) {
  const FrameAnchored before = newest_;
  FrameRecord& record = begin_frame(frame);
  if (!before.anchor) return record;
  newest_.anchor = before.anchor;
  record.state = before.frame.state;
  record.segment = before.frame.segment;
  record.T_world_cam_live = before.frame.T_world_cam_live;
  record.covariance = before.frame.covariance;
  record.p_right = before.frame.p_right;
  record.evidence = before.frame.evidence;
  return record;
}

void FrameLog::publish() { append(newest_); }

void FrameLog::append(FrameAnchored frame) {
  const auto& unit = frame.frame.evidence.unit;
  if (unit && (!unit->is_linked() || unit->by_ground)) unlinked_[frame.frame.index] = frame;
  log_->append(std::move(frame));
}

void FrameLog::constrain_scale(int segment, const RelativeScale& unit) {
  constrain_scale([segment](const FrameRecord& frame) { return frame.segment == segment; }, unit);
}

void FrameLog::constrain_scale(const std::function<bool(const FrameRecord&)>& concerns,
                               const RelativeScale& unit) {
  for (auto i = unlinked_.begin(); i != unlinked_.end();) {
    FrameAnchored& known = i->second;
    const bool is_linked = concerns(known.frame);
    if (is_linked) known.frame.evidence.unit = unit, log_->append(known);
    i = is_linked && !unit.by_ground ? unlinked_.erase(i) : std::next(i);
  }
}

// Within one epoch it says nothing of where the epochs lie.
bool FrameLog::relates_epochs(const Constraint& c) const {
  if (c.from == NodeId::world()) return false;
  const auto from = run_.find_keyframe(c.from.number()), to = run_.find_keyframe(c.to.number());
  if (!from || !to || from->segment != to->segment) return true;
  return placed_.find(from->segment, from->id) != placed_.find(to->segment, to->id);
}

// The ground links what lies between two keyframes.
void FrameLog::follow(const Constraint& c) {
  if (c.kind != ConstraintKind::kGround) return;
  const auto from = run_.find_keyframe(c.from.number()), to = run_.find_keyframe(c.to.number());
  if (!from || !to) return;
  const RelativeScale unit{c.T_from_to.scale, std::sqrt(c.covariance(6, 6)), true};
  constrain_scale(
      [&](const FrameRecord& f) { return from->frame_index < f.index && f.index <= to->frame_index; }, unit);
}

void FrameLog::follow(const MapEvent& event) {
  const auto* added = std::get_if<ConstraintAdded>(&event);
  has_found_more_ |= std::holds_alternative<ConstraintWithdrawn>(event);
  if (!added) return;
  if (added->constraint.kind == ConstraintKind::kPlace)
    knows_places_ = true, ++places_found_, keyframes_at_place_ = run_.keyframes();
  else if (relates_epochs(added->constraint))
    has_found_more_ = true;
  follow(added->constraint);
}

FrameAnchored FrameLog::anchored(FrameRecord record, int segment, const Reference& reference,
                                 const SE3& T_cam_ref) {
  const FrameAnchor anchor{reference.keyframe_id, T_cam_ref, T_cam_ref * reference.T_ref_world,
                           reference.moves};
  record.segment = segment;
  record.T_world_cam_live = run_.T_odom_map(segment).apply(anchor.T_cam_map.inverse());
  record.evidence.median_depth = 1 / reference.median_idepth;
  return {std::move(record), anchor};
}

void FrameLog::place(int segment, const Reference& reference, const SE3& T_cam_ref) {
  newest_ = anchored(std::move(newest_.frame), segment, reference, T_cam_ref);
}

void FrameLog::place(int segment, const LocatedPose& located) {
  const SE3 T_cam_map = located.T_world_cam.inverse();
  newest_.anchor = FrameAnchor{kNoKeyframe, T_cam_map, T_cam_map, 0};
  FrameRecord& record = newest_.frame;
  record.segment = segment;
  record.T_world_cam_live = run_.T_odom_map(segment).apply(located.T_world_cam);
  record.covariance = located.covariance;
  record.evidence.median_depth = located.median_depth;
}

void FrameLog::place(FrameRecord record, int segment, const Reference& reference, const SE3& T_cam_ref) {
  FrameAnchored placed = anchored(std::move(record), segment, reference, T_cam_ref);
  if (placed.frame.index == newest_.frame.index)
    newest_ = std::move(placed);
  else
    append(std::move(placed));
}

std::optional<FrameRecord> FrameLog::find(int frame_index) {
  if (frame_index == newest_.frame.index) return newest_.frame;
  const FrameRecord* record = run().find(frame_index);
  return record ? std::make_optional(*record) : std::nullopt;
}

void FrameLog::begin_segment(const SegmentPlaced& placed) {
  log_->append(placed);
  world_.scale_sigma = std::hypot(world_.scale_sigma, placed.scale_sigma);
  run();
}

void FrameLog::begin_epoch(EpochBegan began, int frame, int later_frame) {
  run().describe_doubt(frame, later_frame, &began);
  log_->append(began);
  run();
}

void FrameLog::add_constraint(const Constraint& constraint) {
  // One between poses that an adjustment has left without a value says nothing, nor does one of a keyframe
  // that the camera has returned to.
  if (constraint.T_from_to.rigid.is_finite() && constraint.covariance.allFinite() &&
      constraint.from != constraint.to)
    log_->add_constraint(constraint);
  run();
}

// So that all solutions together take a share of the run's time, the more keyframes a run has, the more
// places wait for each.
bool FrameLog::are_places_due() const {
  constexpr size_t kKeyframesPerPlace = 40;
  constexpr size_t kKeyframesWithout = 20;  // after the last of them, none is waited for
  const size_t keyframes = run_.keyframes();
  return places_found_ > 0 && (places_found_ > keyframes / kKeyframesPerPlace ||
                               keyframes > keyframes_at_place_ + kKeyframesWithout);
}

void FrameLog::follow_findings(int segment) {
  run();
  if (!placing_ && (has_found_more_ || are_places_due())) {
    has_found_more_ = false;
    places_found_ = 0;
    if (!knows_places_) return announce(run_.place_epochs(), segment);
    placing_ = placer_->begin(run_.keyframes_to_place());
  }
  if (!placing_ || placing_->wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  PlacedEpochs placed = placing_->get();
  placing_.reset();
  // An epoch that has begun meanwhile is not in it.
  if (placed.epochs.size() == run_.epochs())
    announce(std::move(placed), segment);
  else
    has_found_more_ = true;
}

void FrameLog::announce(PlacedEpochs found, int segment) {
  // Of the newest frame; a replayed one is in the run already.
  const bool is_newest = newest_.anchor && newest_.frame.segment == segment;
  const std::optional<SE3> T_cam_map =
      is_newest ? newest_.anchor->T_cam_map : run().pose_before(std::numeric_limits<int>::max(), segment);
  EpochsPlaced placed =
      run_.follow_epochs(std::move(found), segment, T_cam_map.value_or(SE3()).inverse().translation());
  placed_.epochs = placed.epochs;
  world_ = {placed.T_world_odom, world_.changes + 1,
            placed_.find(segment, std::numeric_limits<int>::max())->scale_sigma};
  log_->append(std::move(placed));
  run();
}

double FrameLog::scale_of(int segment, int keyframe_id) const {
  const EpochPlace* epoch = placed_.find(segment, keyframe_id);
  return epoch ? epoch->T_world_map.scale : run_.T_odom_map(segment).scale;
}

RunBuilder& FrameLog::run() {
  for (std::shared_ptr<const MapEvent>& event : cursor_.read()) {
    run_.apply(*event);
    follow(*event);
    event.reset();
  }
  return run_;
}

}  // namespace edgevo
