#pragma once
// Collects what a run leaves behind. Poses are kept relative to keyframes until the end, so that every frame
// profits from the final keyframe poses. All of it belongs to the tracking thread but map(), which mapping
// writes to.
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

class RunRecords {
 public:
  explicit RunRecords(const Pinhole& pinhole);

  FrameRecord& begin_frame(const Frame& frame);
  FrameRecord* find(int frame_index);

  /// The live poses of a segment up to `last_frame`, `at_most` of them, the oldest first.
  std::vector<TimedPose> last_poses(int segment, int last_frame, size_t at_most) const;
  /// Fixes where a segment's map lies in the world (segment_join.h).
  void begin_segment(int segment, const Sim3& T_world_map);
  /// Hangs a frame on a keyframe and notes its live pose.
  void place(FrameRecord* record, int segment, int keyframe_id, const SE3& T_cam_ref, const SE3& T_ref_map);
  /// T_cam_map of the last placed frame of `segment` before `frame_index`.
  std::optional<SE3> pose_before(int frame_index, int segment) const;

  /// World over map, of a segment that has begun.
  double scale_of(int segment) const { return T_world_map_[size_t(segment)].scale; }
  /// Keyframes that have retired, but for the first `skip`, in the world.
  SettledKeyframes settled(size_t skip) const;
  /// The keyframes of the window, in the world; none if they were `version`.
  std::optional<UnsettledKeyframes> unsettled(int version) const;

  /// The part that mapping writes to, in its own thread.
  MapRecords& map() { return map_; }

  /// Final poses and keyframes. Call once.
  Run finish();

 private:
  struct Hook {  // what a frame hangs on
    int keyframe_id = -1;
    int revision = 0;  // of the map that T_cam_ref was measured in
    SE3 T_cam_ref;
    SE3 T_cam_map_live;
  };

  void hang_on_itself(int keyframe_id, const KeyframeRecord& keyframe);
  void finish_frame(const MapRecords::Everything& map, const std::map<int, int>& position_of_keyframe,
                    const std::vector<KeyframeRecord>& keyframes, FrameRecord* frame) const;

  Pinhole pinhole_;
  std::deque<FrameRecord> frames_;
  std::map<int, size_t> position_;  // frame index -> frames_
  std::map<int, Hook> hooks_;       // by frame index
  std::vector<Sim3> T_world_map_;   // by segment
  MapRecords map_;
};

}  // namespace edgevo
