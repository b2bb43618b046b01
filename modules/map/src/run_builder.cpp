// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/run_builder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/record_units.h"
#include "edgevo/map/corrected_pixel.h"
#include "edgevo/map/located_pose.h"

namespace edgevo {
namespace {

std::string in_words(SegmentPlaced::Method method) {
  using Method = SegmentPlaced::Method;
  switch (method) {
    case Method::kOrigin:
      return "origin";
    case Method::kVelocity:
      return "equal speed";
    case Method::kDepthRatio:
      return "ratio of depths";
    case Method::kStandstill:
      return "nothing (standstill)";
    case Method::kLinked:
      return "views of both maps";
  }
  return {};
}

double doubt_of(const FrameRecord& frame) { return std::isfinite(frame.p_right) ? 1 - frame.p_right : 1; }
double unit_variance_of(const FrameMapped& mapped) {
  return mapped.adjustment ? mapped.adjustment->unit_variance : 0;
}

void move_points(const KeyframeMove& move, std::vector<EdgePoint>* points) {
  const float ratio = float(move.scale_ratio);
  for (size_t i = 0; i < points->size(); ++i) {
    EdgePoint& p = (*points)[i];
    // Not by the ratio of the two depths: a point that moves to infinity does not become more certain.
    p.idepth_sigma /= ratio;
    if (i < move.points.size()) {
      p.px = move.points[i].px.cast<float>();
      p.idepth = float(move.points[i].idepth);
    } else {
      p.idepth /= ratio;
    }
  }
}

}  // namespace

void apply_move(const Rectification& rectification, const MapMoved& moved, const KeyframeMove& move,
                KeyframeRecord* keyframe) {
  keyframe->T_world_cam = moved.T_cam_map(move).inverse();
  move_points(move, &keyframe->points);
  for (EdgeLine& line : keyframe->lines)
    for (EdgeVertex& v : line.vertices) apply_move(rectification, moved, move, &v);
}

void apply_move(const Rectification& rectification, const MapMoved& moved, const KeyframeMove& move,
                EdgeVertex* v) {
  if (const std::optional<LensChange>& lens = moved.lens)
    v->px = correct_pixel(rectification, lens->before, lens->now, move.motion, v->px.cast<double>())
                .cast<float>();
  v->idepth /= float(move.scale_ratio);
  v->idepth_sigma /= float(move.scale_ratio);
}

void move_to_world(const Sim3& T_world_map, KeyframeRecord* k) {
  k->T_world_cam = T_world_map.apply(k->T_world_cam);
  multiply_depths(T_world_map.scale, k);
}

RunBuilder::RunBuilder(const Rectification& rectification) : rectification_(rectification) {}

// ---- events ----

void RunBuilder::apply(const MapEvent& event) {
  std::visit([this](const auto& e) { handle(e); }, event);
}

void RunBuilder::handle(const SegmentPlaced& e) {
  if (e.segment < 0 || size_t(e.segment) > T_odom_map_.size()) return;  // in a damaged log only
  if (!is_known(e.segment)) {
    path_.epochs.begin_segment(e, T_odom_map_.empty() ? Sim3() : T_odom_map_.back());
    T_odom_map_.resize(size_t(e.segment) + 1);
  }
  T_odom_map_[size_t(e.segment)] = e.T_world_map;
  segments_.resize(T_odom_map_.size());
  segments_[size_t(e.segment)] = {in_words(e.method), e.scale_sigma};
}

void RunBuilder::handle(const EpochsPlaced& e) {
  if (!e.epochs.empty() && is_known(e.segment)) T_odom_map_[size_t(e.segment)] = e.T_odom_map;
}

void RunBuilder::handle(const KeyframeMarginalised& e) {
  add_keyframe(e.id, e.keyframe);
  if (!forgets() && !e.neighbours.empty()) path_.neighbours[e.id] = e.neighbours.front();
}

void RunBuilder::add_keyframe(int id, std::shared_ptr<const KeyframeRecord> keyframe) {
  if (!is_known(keyframe->segment)) return;
  path_.marginalised[id] = {id, keyframe->segment, keyframe->frame_index, keyframe->T_world_cam};
  if (!forgets()) keyframes_[id].keyframe = std::move(keyframe);
}

void RunBuilder::handle(const MapMoved& e) {
  ++moves_;
  for (const KeyframeMove& move : e.keyframes)
    if (const auto place = path_.marginalised.find(move.id); place != path_.marginalised.end())
      place->second.T_map_cam = e.T_cam_map(move).inverse();
  if (forgets()) return;
  const double image_ratio = e.lens ? (1 + e.lens->before.focal) / (1 + e.lens->now.focal) : 1;
  for (const KeyframeMove& move : e.keyframes) {
    changes_[move.id].push_back({moves_, move.scale_ratio, image_ratio});
    if (const auto motion = path_.neighbours.find(move.id); motion != path_.neighbours.end())
      scale_motion(move.scale_ratio, &motion->second);
    const auto known = keyframes_.find(move.id);
    // A keyframe that is still in the window is marginalised with its new values.
    if (known == keyframes_.end()) continue;
    Entry& entry = known->second;
    auto keyframe = std::make_shared<KeyframeRecord>(*entry.keyframe);
    keyframe->lines = std::move(entry.lines);
    apply_move(rectification_, e, move, keyframe.get());
    entry.lines = std::exchange(keyframe->lines, {});
    entry.keyframe = std::move(keyframe);
  }
}

void RunBuilder::handle(const LinesFinished& e) {
  const auto known = keyframes_.find(e.keyframe_id);
  if (known != keyframes_.end()) known->second.lines = e.lines;
}

void RunBuilder::handle(const FrameMapped& e) {
  const auto known = position_.find(e.frame_index);
  if (known != position_.end()) row(known->second).mapping = e;
}

void RunBuilder::handle(const FrameAnchored& e) {
  const bool is_forgotten = forgotten_ > 0 && !rows_.empty() && e.frame.index < rows_.front().frame.index;
  if (is_forgotten) return;
  const auto [known, is_new] = position_.emplace(e.frame.index, frames());
  if (is_new) rows_.emplace_back();
  Row& changed = row(known->second);
  changed.frame = e.frame;
  changed.anchor = e.anchor;
  while (forgets() && rows_.size() > most_rows_) {
    forget_places_before(rows_.front().frame.index);
    position_.erase(rows_.front().frame.index);
    rows_.pop_front();
    ++forgotten_;
  }
}

// But those that constraints refer to, or may.
void RunBuilder::forget_places_before(int frame_index) {
  for (auto place = path_.marginalised.begin();
       place != path_.marginalised.end() && place->second.frame_index < frame_index;)
    place = kept_.count(place->first) > 0 || path_.epochs.refers_to(place->first)
                ? std::next(place)
                : path_.marginalised.erase(place);
}

// ---- epochs ----

void RunBuilder::describe_doubt(int frame, int later_frame, EpochBegan* began) const {
  double variance = 0;
  began->is_doubted = false;
  for (auto next = position_.upper_bound(frame); next != position_.end() && next->first <= later_frame;
       ++next) {
    const Row& between = row(next->second);
    variance += unit_variance_of(between.mapping);
    began->is_doubted |= !between.anchor || is_map_in_doubt(between.frame);
  }
  began->unit_sigma = std::sqrt(variance);
}

double RunBuilder::doubt_between(int frame, int later_frame) const {
  double doubt = 0;
  for (auto next = position_.upper_bound(frame); next != position_.end() && next->first <= later_frame;
       ++next)
    doubt += doubt_of(row(next->second).frame) + unit_variance_of(row(next->second).mapping);
  return doubt;
}

RunSoFar RunBuilder::run_so_far() const {
  return path_.run_so_far([this](int frame, int later_frame) { return doubt_between(frame, later_frame); });
}

PlacedEpochs RunBuilder::place_keyframes() const {
  return path_.epochs.solve_keyframes(run_so_far(), path_.keyframes());
}

// Doubts matter between epochs alone.
std::function<PlacedEpochs()> RunBuilder::keyframes_to_place() const {
  auto path = std::make_shared<const RunPath>(path_);
  std::map<int, double> doubts;  // by frame, the sum up to it
  if (path_.epochs.count() > 1)
    for (const auto& [frame, number] : position_)
      doubts[frame] = (doubts.empty() ? 0 : doubts.rbegin()->second) + doubt_of(row(number).frame) +
                      unit_variance_of(row(number).mapping);
  return [path, doubts = std::move(doubts)] {
    const auto up_to = [&](int frame) {
      const auto after = doubts.upper_bound(frame);
      return after == doubts.begin() ? 0.0 : std::prev(after)->second;
    };
    const auto doubt = [&](int frame, int later_frame) { return up_to(later_frame) - up_to(frame); };
    return path->epochs.solve_keyframes(path->run_so_far(doubt), path->keyframes());
  };
}

// T_odom_map' p = s' R p + t'  with the scale s' that was found, and t' such that the newest pose stays.
EpochsPlaced RunBuilder::follow_epochs(PlacedEpochs placed, int segment,
                                       const Eigen::Vector3d& newest_position) const {
  const Sim3 T_world_map = placed.find(segment, std::numeric_limits<int>::max())->T_world_map;
  const Sim3& before = T_odom_map(segment);
  Sim3 T_odom_map{T_world_map.scale, SE3(before.rigid.rotation(), Eigen::Vector3d::Zero())};
  T_odom_map.rigid = SE3(before.rigid.rotation(), before * newest_position - T_odom_map * newest_position);
  return {std::move(placed.epochs), segment, T_odom_map, (T_world_map * T_odom_map.inverse()).rigid,
          placed.newest_constraint};
}

// ---- the run so far ----

const FrameRecord* RunBuilder::find(int frame_index) const {
  const auto known = position_.find(frame_index);
  return known == position_.end() ? nullptr : &row(known->second).frame;
}

std::vector<TimedPose> RunBuilder::last_poses(int segment, int last_frame, size_t at_most) const {
  std::vector<TimedPose> poses;
  for (auto row = rows_.rbegin(); row != rows_.rend() && poses.size() < at_most; ++row) {
    const FrameRecord& f = row->frame;
    if (f.T_world_cam_live && f.segment == segment && f.index <= last_frame)
      poses.push_back({f.time, *f.T_world_cam_live});
  }
  std::reverse(poses.begin(), poses.end());
  return poses;
}

std::vector<TimedPose> RunBuilder::last_trusted_poses(int segment, int last_frame, size_t count) const {
  std::vector<TimedPose> poses;
  for (auto row = rows_.rbegin(); row != rows_.rend() && poses.size() < count; ++row) {
    const FrameRecord& f = row->frame;
    if (f.index > last_frame || f.segment > segment) continue;
    if (f.segment == segment && f.T_world_cam_live && !is_map_in_doubt(f))
      poses.push_back({f.time, *f.T_world_cam_live});
    else
      poses.clear();
  }
  if (poses.size() < count) return {};
  std::reverse(poses.begin(), poses.end());
  return poses;
}

std::optional<SE3> RunBuilder::pose_before(int frame_index, int segment) const {
  auto next = position_.lower_bound(frame_index);
  while (next != position_.begin()) {
    const Row& before = row((--next)->second);
    if (!before.anchor) continue;
    if (before.frame.segment != segment) return std::nullopt;
    return before.anchor->T_cam_map;
  }
  return std::nullopt;
}

// ---- the end ----

size_t RunBuilder::adopt_window() {
  if (!path_.window.keyframes || path_.window.moves != moves_) return 0;
  const size_t before = keyframes_.size();
  for (const WindowAdjusted::Active& active : *path_.window.keyframes)
    if (keyframes_.count(active.id) == 0 && position_.count(active.keyframe.frame_index) > 0)
      add_keyframe(active.id, std::make_shared<const KeyframeRecord>(active.keyframe));
  return keyframes_.size() - before;
}

// What has changed near a keyframe since that many moves of the map.
RunBuilder::Change RunBuilder::changes_since(int keyframe_id, int moves) const {
  Change all{moves_, 1, 1};
  const auto known = changes_.find(keyframe_id);
  if (known == changes_.end()) return all;
  for (const Change& c : known->second)
    if (c.move > moves) all.scale_ratio *= c.scale_ratio, all.image_ratio *= c.image_ratio;
  return all;
}

// A keyframe's frame takes the final pose of the keyframe: that was adjusted, unlike the pose from tracking.
void RunBuilder::anchor_to_own_keyframe(int keyframe_id, const KeyframeRecord& keyframe) {
  const auto known = position_.find(keyframe.frame_index);
  if (known == position_.end()) return;
  auto& [frame, anchor, mapping] = row(known->second);
  frame.is_keyframe = true;
  frame.is_doubtful_keyframe = keyframe.is_doubtful;
  if (frame.keyframe_reason == KeyframeReason::kNone) frame.keyframe_reason = KeyframeReason::kBootstrap;
  if (!anchor || frame.segment != keyframe.segment) return;
  anchor->keyframe_id = keyframe_id;
  anchor->T_cam_ref = SE3();
}

// Computes the final pose of a frame from that of its keyframe.
void RunBuilder::finish_row(const PlacedEpochs& placed, const std::map<int, int>& position_of_keyframe,
                            const std::vector<KeyframeRecord>& keyframes, Row* row) const {
  FrameRecord& frame = row->frame;
  const StageTimes& times = row->mapping.times;
  frame.stage_ms.insert(frame.stage_ms.end(), times.begin(), times.end());
  if (row->mapping.adjustment) frame.evidence.adjustment = row->mapping.adjustment;
  if (!row->anchor || !is_known(frame.segment)) return;
  const FrameAnchor& anchor = *row->anchor;
  const Change change = changes_since(anchor.keyframe_id, anchor.moves);
  const double length = placed.T_world_map(frame.segment, anchor.keyframe_id).scale * change.scale_ratio;
  multiply_lengths(length, &frame);
  const auto keyframe = position_of_keyframe.find(anchor.keyframe_id);
  if (keyframe == position_of_keyframe.end()) {
    frame.T_world_cam =
        forgets() ? frame.T_world_cam_live
                  : placed.T_world_map(frame.segment, anchor.keyframe_id).apply(anchor.T_cam_map.inverse());
    return;
  }
  frame.reference_keyframe = keyframe->second;
  const SE3 T_ref_cam =
      (change.image_ratio == 1 ? anchor.T_cam_ref : correct_motion(anchor.T_cam_ref, change.image_ratio))
          .inverse();
  const SE3 T_ref_cam_scaled(T_ref_cam.rotation(), length * T_ref_cam.translation());
  frame.T_world_cam = keyframes[size_t(keyframe->second)].T_world_cam * T_ref_cam_scaled;
}

std::vector<EpochRecord> RunBuilder::epoch_records(const PlacedEpochs& placed) const {
  std::map<const EpochPlace*, EpochRecord> found;
  for (const Row& row : rows_) {
    if (!row.anchor || !is_known(row.frame.segment)) continue;
    const EpochPlace* place = placed.find(row.frame.segment, row.anchor->keyframe_id);
    const int frame = row.frame.index;
    EpochRecord& record = found
                              .try_emplace(place, EpochRecord{place->segment, place->epoch, frame, frame,
                                                              place->T_world_map.scale, place->scale_sigma})
                              .first->second;
    record.first_frame = std::min(record.first_frame, frame);
    record.last_frame = std::max(record.last_frame, frame);
  }
  std::vector<EpochRecord> records;
  for (const EpochPlace& place : placed.epochs)
    if (const auto known = found.find(&place); known != found.end()) records.push_back(known->second);
  return records;
}

std::vector<ConstraintRecord> RunBuilder::constraint_records(const PlacedEpochs& placed) const {
  std::vector<ConstraintRecord> records;
  for (const auto& [id, c] : path_.epochs.constraints()) {
    const bool is_in_kept_map = c.from == NodeId::world();
    const auto from = path_.find(c.from.number()), to = path_.find(c.to.number());
    if ((!from && !is_in_kept_map) || !to) continue;
    records.push_back({to_string(c.kind), is_in_kept_map ? -1 : from->frame_index, to->frame_index,
                       c.T_from_to.scale, std::sqrt(c.covariance(6, 6)), !placed.is_unused(id)});
  }
  // Frames that were located before the run had a map.
  for (const Row& row : rows_)
    if (row.anchor && row.anchor->keyframe_id == kNoKeyframe)
      records.push_back({to_string(ConstraintKind::kPlace), -1, row.frame.index, 1,
                         std::numeric_limits<double>::quiet_NaN(), true});
  return records;
}

Run RunBuilder::finish() {
  const PlacedEpochs placed = place_keyframes();
  Run run;
  run.pinhole = rectification_.target();
  run.camera = camera_;
  run.segments = segments_;
  run.epochs = epoch_records(placed);
  run.constraints = constraint_records(placed);
  std::map<int, int> position_of_keyframe;  // in run.keyframes
  for (auto& [id, entry] : keyframes_) {
    KeyframeRecord keyframe = *entry.keyframe;
    keyframe.lines = std::move(entry.lines);
    entry = {};
    move_to_world(placed.T_world_map(keyframe.segment, id), &keyframe);
    position_of_keyframe[id] = int(run.keyframes.size());
    anchor_to_own_keyframe(id, keyframe);
    run.keyframes.push_back(std::move(keyframe));
  }
  for (Row& row : rows_) {
    finish_row(placed, position_of_keyframe, run.keyframes, &row);
    run.frames.push_back(std::move(row.frame));
  }
  if (moves_ > 0 && !forgets() && !is_in_kept_map(run)) move_first_to_origin(&run);
  return run;
}

}  // namespace edgevo
