// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Collects the results of a run. Poses are kept relative to keyframes until the end, so that every frame
// profits from the final keyframe poses. For the tracking thread, except map(), which mapping writes to.
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/live_keyframes.h"
#include "edgevo/core/records.h"
#include "map_records.h"
#include "segment_join.h"

namespace edgevo {

/// Frames, keyframes and segments of a run.
class RunRecords {
 public:
  explicit RunRecords(const Pinhole& pinhole);

  /// Appends the record of a frame.
  FrameRecord& begin_frame(const Frame& frame);
  /// The record of a frame; null if there is none.
  FrameRecord* find(int frame_index);

  /// The live poses of a segment up to `last_frame`: the last `at_most` of them, oldest first.
  std::vector<TimedPose> last_poses(int segment, int last_frame, size_t at_most) const;
  /// Fixes the pose of a segment's map in the world (segment_join.h).
  void begin_segment(int segment, const Sim3& T_world_map);
  /// Anchors a frame to a keyframe and records its live pose.
  void place(FrameRecord* record, int segment, int keyframe_id, const SE3& T_cam_ref, const SE3& T_ref_map);
  /// T_cam_map of the last placed frame of `segment` before `frame_index`.
  std::optional<SE3> pose_before(int frame_index, int segment) const;

  /// Unit of length in the world over that of the map, for a segment that has begun.
  double scale_of(int segment) const { return T_world_map_[size_t(segment)].scale; }
  /// The marginalised keyframes in the world, from index `first` on.
  MarginalisedKeyframes marginalised(size_t first) const;
  /// The keyframes of the window in the world; nothing if they still are `version`.
  std::optional<ActiveKeyframes> active(int version) const;

  /// The part that mapping writes to from its own thread.
  MapRecords& map() { return map_; }

  /// Returns final poses and keyframes. Call once.
  Run finish();

 private:
  /// Keyframe and relative pose that a frame's final pose is computed from.
  struct FrameAnchor {
    int keyframe_id = -1;
    int revision = 0;  // of the map in which T_cam_ref was measured
    SE3 T_cam_ref;
    SE3 T_cam_map_live;
  };

  void anchor_to_own_keyframe(int keyframe_id, const KeyframeRecord& keyframe);
  void finish_frame(const MapRecords::Everything& map, const std::map<int, int>& position_of_keyframe,
                    const std::vector<KeyframeRecord>& keyframes, FrameRecord* frame) const;

  Pinhole pinhole_;
  std::deque<FrameRecord> frames_;
  std::map<int, size_t> position_;      // frame index -> frames_
  std::map<int, FrameAnchor> anchors_;  // by frame index
  std::vector<Sim3> T_world_map_;       // by segment
  MapRecords map_;
};

}  // namespace edgevo
