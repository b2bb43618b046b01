#pragma once
// Collects what a run leaves behind. Poses are kept relative to keyframes until the end, so that every frame
// profits from the final keyframe poses. The mapping thread may call note_mapping, note_window, retire and
// revise; everything else belongs to the tracking thread.
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "edgevo/core/image.h"
#include "edgevo/core/live_keyframes.h"
#include "edgevo/core/records.h"
#include "edgevo/odometry/mapper.h"

namespace edgevo {

class RunRecords {
 public:
  explicit RunRecords(const Pinhole& pinhole);

  FrameRecord& begin_frame(const Frame& frame);
  FrameRecord* find(int frame_index);

  /// Fixes where a segment's map lies in the world: the first at the origin, a later one by constant velocity
  /// from the last pose up to the bootstrap's first view. `scale`, world over map, where it is known better
  /// than by equal speed.
  void begin_segment(int segment, const BootstrapResult& bootstrap, std::optional<double> scale);
  /// Hangs a frame on a keyframe and notes its live pose.
  void place(FrameRecord* record, int segment, int keyframe_id, const SE3& T_cam_ref, const SE3& T_ref_map);
  /// T_cam_map of the last placed frame of `segment` before `frame_index`.
  std::optional<SE3> pose_before(int frame_index, int segment) const;

  /// World over map, of a segment that has begun.
  double scale_of(int segment) const { return T_world_map_[size_t(segment)].scale; }
  /// What retire() was given so far, but for the first `skip`, in the world.
  SettledKeyframes settled(size_t skip) const;

  /// What note_window() was given last, in the world; none if that was `version`.
  std::optional<UnsettledKeyframes> unsettled(int version) const;

  void note_mapping(int frame_index, const MapUpdate& update);
  /// The window as it stands; empty: there is none.
  void note_window(const std::deque<Keyframe>& keyframes, int segment);
  void retire(std::vector<Keyframe> keyframes, int segment);
  /// Of keyframes that have retired.
  void set_lines(std::vector<HostedLines> hosted);
  /// The camera was corrected: keyframes of the present segment have moved.
  void revise(std::vector<RevisedKeyframe> keyframes);

  /// Final poses and keyframes. Call once.
  Run finish();

 private:
  struct Hook {  // what a frame hangs on
    int keyframe_id = -1;
    int revision = 0;  // of the map that T_cam_ref was measured in
    SE3 T_cam_ref;
    SE3 T_cam_map_live;
  };

  int current_revision();
  double length_ratio_since(int keyframe_id, int revision) const;
  void hang_on_itself(int keyframe_id, const KeyframeRecord& keyframe);

  Pinhole pinhole_;
  std::deque<FrameRecord> frames_;
  std::map<int, size_t> position_;           // frame index -> frames_
  std::map<int, Hook> hooks_;                // by frame index
  std::vector<Sim3> T_world_map_;            // by segment
  mutable std::mutex mutex_;                 // guards what follows
  std::map<int, StageTimes> mapping_times_;  // by frame index
  int revision_ = 0;                         // corrections of the map so far
  std::map<int, std::vector<std::pair<int, double>>>
      length_ratio_;                         // by keyframe id: revision, new over old length
  std::map<int, KeyframeRecord> keyframes_;  // by keyframe id; pose and points still in the segment's map
  UnsettledKeyframes window_;                // pose and points in the segment's map
  std::vector<int> retired_;                 // their ids in the order of retiring
};

}  // namespace edgevo
