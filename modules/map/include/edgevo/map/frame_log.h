// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tracking side's end of the stream of events: announces frames and segments, and reads back the run that
// all events so far make.
#include <map>
#include <memory>
#include <optional>

#include "edgevo/alignment/reference.h"
#include "edgevo/core/image.h"
#include "edgevo/core/motion_history.h"
#include "edgevo/core/records.h"
#include "edgevo/map/map_log.h"
#include "edgevo/map/run_builder.h"

namespace edgevo {

/// Frames and segments of a run; for the tracking thread.
class FrameLog {
 public:
  /// `log`, not null, receives the events, and `history`, which must outlive this object, the frames.
  FrameLog(const Rectification& rectification, std::shared_ptr<MapLog> log, MotionHistory* history);

  /// Keeps the newest frames only: those of a long bootstrap, and of the poses before a loss.
  void forget() {
    constexpr size_t kKept = 2000;
    run_.forget_all_but(kKept);
  }
  /// Begins the record of a frame, which becomes the newest one.
  FrameRecord& begin_frame(const Frame& frame);
  /// Anchors the newest frame to the keyframe of `reference` and records its live pose.
  void place(int segment, const Reference& reference, const SE3& T_cam_ref);
  /// Announces the newest frame; again if its record has changed since.
  void publish();

  /// Anchors an earlier frame, or the newest one, with a record that replaces the present one; announces an
  /// earlier one.
  void place(FrameRecord record, int segment, const Reference& reference, const SE3& T_cam_ref);
  /// The record of a frame; nothing if there is none.
  std::optional<FrameRecord> find(int frame_index);
  /// MotionHistory::reported_ratio() of a frame with the pose `T_cam_map` in a segment's map.
  double reported_ratio(int frame_index, int segment, const SE3& T_cam_map) const;
  /// Announces the frames of a segment again at which nothing linked the unit of length to that before: now
  /// it is.
  void constrain_scale(int segment, const RelativeScale& unit);
  /// Announces the pose of a segment's map in the world.
  void begin_segment(const SegmentPlaced& placed);

  /// From the map of a segment that has begun to the world.
  const Sim3& T_world_map(int segment) const { return run_.T_world_map(segment); }
  /// The run so far. Cost: that of the events since the last call.
  RunBuilder& run();

 private:
  void append(FrameAnchored frame);
  FrameAnchored anchored(FrameRecord record, int segment, const Reference& reference, const SE3& T_cam_ref);

  std::shared_ptr<MapLog> log_;
  MotionHistory* history_;
  MapCursor cursor_;
  RunBuilder run_;
  FrameAnchored newest_;
  std::map<int, FrameAnchored> unlinked_;  // by frame
};

}  // namespace edgevo
