// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Poses, transforms, velocities and states of the frames of a run.
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "edgevo/map/map_event.h"
#include "final_part.h"
#include "live_frames.h"
#include "ros_messages.h"
#include "topics.h"

namespace edgevo {

/// Writes what frames say. For one thread.
class PoseStream {
 public:
  /// `file` and `frames` must outlive this object.
  PoseStream(TopicFile* file, const LiveFrames* frames) : file_(*file), frames_(*frames) {}

  /// Whether a frame is one that has not been seen yet.
  bool is_new(const FrameRecord& frame) const { return frame.index > newest_; }
  /// A frame was processed, or got its pose later: its messages then have the time of the newest frame as
  /// theirs, and their own in the header.
  void add(const FrameRecord& frame);
  /// The epochs were placed anew.
  void note_change(const EpochsPlaced& placed);
  /// A segment has begun.
  void note_segment(const SegmentPlaced& placed);
  /// A line for people.
  void log(RosLevel level, const std::string& text);

  /// Time of the newest frame.
  Timestamp now() const { return now_; }
  /// Where the poses end.
  LiveEnd end() const { return {now_, frames_.T_base_cam(), newest_pose_}; }
  /// The final place of odom, if it is another one than that of before; `count`: the number of the change.
  void write_last_change(const std::optional<SE3>& T_map_odom, int count);
  /// Number of changes of map -> odom, as written.
  int changes() const { return changes_; }

 private:
  struct KnownPose {
    Timestamp time;
    int segment = 0;
    SE3 T_odom_base;
    Matrix6d covariance;  // body_covariance()
  };

  void begin(Timestamp time);
  void write_changes(int count);
  void note_state(const FrameRecord& frame, bool is_new);
  void write_pose(const FrameRecord& frame);
  void write_odometry(const FrameRecord& frame, const KnownPose& pose);
  std::optional<RosTwist> twist_at(int frame_index, const KnownPose& pose) const;
  void forget_old();

  TopicFile& file_;
  const LiveFrames& frames_;
  int newest_ = -1;  // index
  Timestamp now_;
  bool has_begun_ = false;
  std::optional<TrackingState> state_;
  std::optional<std::pair<Timestamp, SE3>> newest_pose_;  // T_odom_base
  std::set<int> without_pose_;                            // indices of recent frames
  std::map<int, KnownPose> recent_;                       // by index
  int changes_ = -1;
};

}  // namespace edgevo
