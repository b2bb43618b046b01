// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stream of events of a made-up run (synthetic_run.h), as an odometry would have made it: two segments,
// poses found late, a window of keyframes, and a past that moves without a change of the camera. For the
// tests of whoever follows the events.
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "edgevo/core/depth_source.h"
#include "edgevo/core/record_units.h"
#include "edgevo/map/map_event.h"
#include "support/synthetic_run.h"

namespace edgevo::test {

/// The events of one frame, in their order.
using FrameEvents = std::vector<std::shared_ptr<const MapEvent>>;

inline void append(MapEvent event, FrameEvents* events) {
  events->push_back(std::make_shared<const MapEvent>(std::move(event)));
}

/// From the map of a segment to the world: the second segment has half the unit of the first.
inline Sim3 T_world_map_of(int segment) {
  if (segment == 0) return {};
  return {0.5, SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), {1, 0, 2})};
}

/// A keyframe of the run in its segment's map.
inline KeyframeRecord in_map(KeyframeRecord keyframe) {
  const Sim3 T_map_world = T_world_map_of(keyframe.segment).inverse();
  keyframe.T_world_cam = T_map_world.apply(keyframe.T_world_cam);
  multiply_depths(T_map_world.scale, &keyframe);
  return keyframe;
}

/// A move of some keyframes by the similarity about the newest one that turns and enlarges what lies behind.
inline MapMoved move_past(const std::vector<std::pair<int, KeyframeRecord>>& keyframes,
                          const SE3& T_newest_map, int segment, double growth) {
  MapMoved moved;
  moved.segment = segment;
  moved.T_newest_map = T_newest_map;
  const Sim3 change{growth,
                    SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY())), {0, 0, 0})};
  for (const auto& [id, keyframe] : keyframes) {
    KeyframeMove move;
    move.id = id;
    move.T_cam_newest = change.apply(T_newest_map * keyframe.T_world_cam).inverse();
    move.scale_ratio = growth;
    moved.keyframes.push_back(move);
  }
  return moved;
}

/// Makes the events frame by frame. Keyframe ids are ten times their number in the run.
class MadeEvents {
 public:
  static constexpr size_t kWindow = 4;
  static constexpr int kFirstPose = 4;    // the frames before are placed when this one is
  static constexpr int kMovedAfter = 42;  // frame after which the past has moved
  static constexpr double kGrowth = 1.25;

  explicit MadeEvents(const SyntheticRun& made) : run_(made.run) {
    for (const FrameRecord& frame : run_.frames) frames_.push_back(make(frame));
    close_window(&frames_.back());
  }
  /// One entry for each frame.
  const std::vector<FrameEvents>& frames() const { return frames_; }

 private:
  FrameEvents make(const FrameRecord& frame) {
    FrameEvents events;
    if (frame.segment != segment_) begin_segment(frame, &events);
    append(FrameAnchored{as_tracked(frame), frame.index < kFirstPose ? std::nullopt : anchor(frame)},
           &events);
    if (frame.index == kFirstPose)
      for (int i = 0; i < kFirstPose; ++i) append(placed_late(run_.frames[size_t(i)]), &events);
    if (frame.is_keyframe) add_keyframe(frame, &events);
    if (frame.index == kMovedAfter) move(&events);
    append(FrameMapped{frame.index, {{"ba", 0.25 * frame.index}}}, &events);
    return events;
  }
  void begin_segment(const FrameRecord& frame, FrameEvents* events) {
    close_window(events);
    segment_ = frame.segment;
    if (segment_ >= 0)
      append(SegmentPlaced{segment_, T_world_map_of(segment_), SegmentPlaced::Method(2 * segment_)}, events);
  }
  static FrameRecord as_tracked(FrameRecord frame) {
    frame.is_keyframe = false;
    frame.reference_keyframe = -1;
    frame.T_world_cam = std::nullopt;
    return frame;
  }
  FrameAnchored placed_late(FrameRecord frame) const {
    const auto at = anchor(frame);
    frame.T_world_cam_live = frame.T_world_cam;
    return {as_tracked(frame), at};
  }
  // The keyframe at or before the frame.
  std::optional<FrameAnchor> anchor(const FrameRecord& frame) const {
    if (!frame.T_world_cam) return std::nullopt;
    size_t k = run_.keyframes.size() - 1;
    while (k > 0 && run_.keyframes[k].frame_index > frame.index) --k;
    if (run_.keyframes[k].segment != frame.segment) ++k;
    KeyframeRecord as_keyframe;
    as_keyframe.segment = frame.segment;
    as_keyframe.T_world_cam = *frame.T_world_cam;
    const SE3 T_cam_map = in_map(as_keyframe).T_world_cam.inverse();
    return FrameAnchor{10 * int(k), T_cam_map * in_map(run_.keyframes[k]).T_world_cam, T_cam_map, moves_};
  }
  void add_keyframe(const FrameRecord& frame, FrameEvents* events) {
    const int id = 10 * frame.reference_keyframe;
    append(KeyframeAdded{id, frame.index, frame.segment}, events);
    window_.emplace_back(id, in_map(run_.keyframes[size_t(frame.reference_keyframe)]));
    if (window_.size() > kWindow) marginalise_oldest(events);
    adjust(events);
    CameraPosterior camera;
    camera.given.keyframes = id;
    append(CameraEstimated{camera}, events);
  }
  void marginalise_oldest(FrameEvents* events) {
    auto& [id, keyframe] = window_.front();
    NeighbourPose neighbour;
    if (window_.size() > 1) {
      neighbour.id = window_[1].first;
      neighbour.T_leaving_neighbour = keyframe.T_world_cam.inverse() * window_[1].second.T_world_cam;
      neighbour.covariance = 1e-6 * Matrix6d::Identity();
    }
    append(KeyframeMarginalised{id, std::make_shared<const KeyframeRecord>(keyframe), {neighbour}}, events);
    EdgeLine line;
    line.vertices = {{{1, 2}, 0.5f, 0.1f, 3, 4}, {{5, 6}, 0.7f, 0.2f, 7, 8}};
    line.keyframes = id, line.views = 3, line.source = DepthSource::kPlane;
    line.is_outline = true;
    append(LinesFinished{id, {line}}, events);
    marginalised_.emplace_back(id, keyframe);
    window_.pop_front();
  }
  void adjust(FrameEvents* events) const {
    std::vector<WindowAdjusted::Active> active;
    for (const auto& [id, keyframe] : window_) active.push_back({id, keyframe});
    append(WindowAdjusted{moves_, std::make_shared<const std::vector<WindowAdjusted::Active>>(active)},
           events);
  }
  void close_window(FrameEvents* events) {
    if (window_.empty()) return;
    while (!window_.empty()) marginalise_oldest(events);
    adjust(events);
    marginalised_.clear();
  }
  // All but the window.
  void move(FrameEvents* events) {
    append(move_past(marginalised_, window_.back().second.T_world_cam.inverse(), segment_, kGrowth), events);
    ++moves_;
    adjust(events);
  }

  const Run run_;
  std::vector<FrameEvents> frames_;
  int segment_ = -1, moves_ = 0;
  std::deque<std::pair<int, KeyframeRecord>> window_;
  std::vector<std::pair<int, KeyframeRecord>> marginalised_;
};

}  // namespace edgevo::test
