// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tracking side's end of the stream of events: announces frames and segments, and reads back the run that
// all events so far make.
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>

#include "edgevo/alignment/reference.h"
#include "edgevo/core/image.h"
#include "edgevo/core/records.h"
#include "edgevo/core/worker.h"
#include "edgevo/map/located_pose.h"
#include "edgevo/map/map_log.h"
#include "edgevo/map/run_builder.h"

namespace edgevo {

/// Where the frame of live poses lies in the world. It changes when something is found about the past, so
/// that live poses need not.
struct WorldOfOdometry {
  /// From that frame to the world.
  SE3 T_world_odom;
  /// Number of changes so far.
  int changes = 0;
  /// Standard deviation of the logarithm of the unit of length in use; 0: that of the run.
  double scale_sigma = 0;
};

/// Frames and segments of a run; for the tracking thread.
class FrameLog {
 public:
  /// `log`, not null, receives the events.
  /// `own_thread`: places that are seen again are solved for in a thread of its own; what they move, moves
  /// when that is done.
  FrameLog(const Rectification& rectification, std::shared_ptr<MapLog> log, bool own_thread = false);

  /// Keeps the newest frames only: those of a long bootstrap, and of the poses before a loss.
  void forget() {
    constexpr size_t kKept = 2000;
    run_.forget_all_but(kKept);
  }
  /// RunBuilder::keep(): of a view that the map may be linked to once a doubt or a loss has ended.
  void keep(int keyframe_id) { run_.keep(keyframe_id); }
  /// Begins the record of a frame, which becomes the newest one.
  FrameRecord& begin_frame(const Frame& frame);
  /// As begin_frame(), of a frame that has the image of the newest one: it has the pose of that one, too.
  FrameRecord& repeat_frame(const Frame& frame);
  /// Anchors the newest frame to the keyframe of `reference` and records its live pose.
  void place(int segment, const Reference& reference, const SE3& T_cam_ref);
  /// Gives the newest frame its pose in a segment whose map is one that was kept: it has no keyframe.
  void place(int segment, const LocatedPose& located);
  /// Announces the newest frame; again if its record has changed since.
  void publish();

  /// Anchors an earlier frame, or the newest one, with a record that replaces the present one; announces an
  /// earlier one.
  void place(FrameRecord record, int segment, const Reference& reference, const SE3& T_cam_ref);
  /// The record of a frame; nothing if there is none.
  std::optional<FrameRecord> find(int frame_index);
  /// Announces the frames of a segment again at which nothing linked the unit of length to that before, or
  /// only the ground: now it is.
  void constrain_scale(int segment, const RelativeScale& unit);
  /// Announces a segment, and where its map lies in the frame of live poses.
  void begin_segment(const SegmentPlaced& placed);
  /// Announces an epoch after a doubt in the frames after `frame` up to `later_frame`, which it begins with.
  void begin_epoch(EpochBegan began, int frame, int later_frame);
  /// Announces a constraint between keyframes.
  void add_constraint(const Constraint& constraint);
  /// Announces where the epochs lie, if something was found about the past since the last time, by whomever,
  /// or a solution has become ready. Live poses of `segment`, that of the newest frame, have its unit from
  /// the next frame on.
  void follow_findings(int segment);
  /// The same: an epoch has begun.
  void place_epochs(int segment) {
    has_found_more_ = true;
    follow_findings(segment);
  }
  /// World over map of the epoch of a keyframe, as announced last.
  double scale_of(int segment, int keyframe_id) const;

  /// RunBuilder::T_odom_map().
  const Sim3& T_odom_map(int segment) const { return run_.T_odom_map(segment); }
  /// From the frame of live poses to the world, as announced last, and the number of announcements.
  const WorldOfOdometry& world_of_odometry() const { return world_; }
  /// The run so far. Cost: that of the events since the last call.
  RunBuilder& run();

 private:
  void append(FrameAnchored frame);
  FrameAnchored anchored(FrameRecord record, int segment, const Reference& reference, const SE3& T_cam_ref);
  void follow(const MapEvent& event);
  void follow(const Constraint& constraint);
  bool relates_epochs(const Constraint& constraint) const;
  bool are_places_due() const;
  void announce(PlacedEpochs placed, int segment);
  void constrain_scale(const std::function<bool(const FrameRecord&)>& concerns, const RelativeScale& unit);

  std::shared_ptr<MapLog> log_;
  MapCursor cursor_;
  RunBuilder run_;
  FrameAnchored newest_;
  std::map<int, FrameAnchored> unlinked_;  // by frame; also those that only the ground links
  PlacedEpochs placed_;                    // as announced last
  bool has_found_more_ = false;
  size_t places_found_ = 0;        // within an epoch, since the last solution
  size_t keyframes_at_place_ = 0;  // when the newest of them was found
  bool knows_places_ = false;
  std::optional<std::future<PlacedEpochs>> placing_;
  std::unique_ptr<Worker> placer_;
  WorldOfOdometry world_;
};

}  // namespace edgevo
