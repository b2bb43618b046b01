// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The steps of Odometry: each frame's path in odometry.cpp, the making of maps in odometry_maps.cpp.
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "edgevo/confidence/frame_status.h"
#include "edgevo/confidence/integrity_monitor.h"
#include "edgevo/confidence/motion_confidence.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/motion_history.h"
#include "edgevo/features/feature_tracker.h"
#include "edgevo/map/frame_log.h"
#include "edgevo/mapping/map_link.h"
#include "edgevo/mapping/scale_comparisons.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/segmentation/ego_mask_monitor.h"
#include "edgevo/self_calibration/focal_by_corners.h"
#include "edgevo/tracking/backward_replay.h"
#include "edgevo/tracking/bootstrapper.h"
#include "edgevo/tracking/concurrent_bootstrap.h"
#include "edgevo/tracking/front_end.h"
#include "frame_order.h"
#include "state_machine.h"

namespace edgevo {

struct Odometry::Impl {
  Impl(const Rectification& rectification, const OdometryParams& p, const OdometryOptions& o);

  // ---- one frame ----
  FrameRecord process(const Frame& frame);
  void follow_findings();
  const FrameRecord& follow(const Frame& frame, const ImageExposure& exposure);
  FrameRecord pass_over(const Frame& frame, const std::string& why, ImageFault fault);
  FrameRecord use(const Frame& frame, const ImageExposure& exposure);
  // Of a gyro, about an axis, radians; infinity: it has not followed the camera.
  double heading_sigma() const;
  bool is_mapping_behind() const;
  // The motion model bridges the gap, as after lost frames. A frame with the time of the one before has none
  // of its own: the time of the next frame says how long the gap is.
  FrameRecord skip(const Frame& frame, const std::string& why, ImageFault fault = ImageFault::kNone);
  void require_open(const std::string& where) const;
  // Self-calibration may have corrected the map: the next images are corrected in the same way.
  void change_reference(const Frame& frame);
  // A frame that throws leaves no record.
  ArrivedFrame find_edges(const Frame& frame, bool has_pose, const ImageExposure& exposure);

  // ---- tracking in a map ----
  // `is_replayed`: it was answered before, and its record is a copy.
  void follow_map(ArrivedFrame now, bool is_replayed = false);
  void update_coverage_and_features(const ArrivedFrame& now, const SE3& T_cur_ref);
  // In this thread: the pose waits for its evidence, which takes less time than handing it over.
  void track_features(const ArrivedFrame& now, const std::optional<SE3>& T_cur_last,
                      const std::optional<SE3>& T_cam_map = {});
  void record_pose(const TrackResult& tracked, FrameRecord* record, bool is_replayed);
  // The probability that the motion is right, and with it the state that is reported. A frame in doubt is
  // tracked as any other; what it means for the map: watch_integrity().
  void assign_confidence(const FrameStatus& by_image, const ImageZoom& zoom, FrameRecord* record);

  // ---- doubt ----
  void watch_integrity(const ArrivedFrame& now, TrackedFrame* tracked);
  // However long the doubt or the loss will last.
  void keep_views_before();
  // What relates the map to what was seen before this doubt, or an earlier one.
  void keep_links(const ScaleAnswer& answer);
  void report_links(const ArrivedFrame& now, const ScaleAnswer& answer);

  // ---- making a map ----
  void forget_views();
  void bootstrap_map(const ArrivedFrame& now);
  void refuse_pose(FrameRecord* record, const Reasons& why) const;
  // The pose of a frame in a map that was kept, as long as the run has none of its own.
  std::optional<LocatedPose> locate(const ArrivedFrame& now);
  // Whether the first map waits for images that may be.
  bool may_be_located() const;
  // Where keyframes of the first map lie in the map that was kept, by the first frame located on each.
  void place_young_map(const ArrivedFrame& now);
  void look_again();
  BootstrapStatus search_and_make(const ArrivedFrame& now);
  // Begins a new segment. Returns nothing, or why the two views make no map.
  Reasons make_map(const ArrivedFrame& now, const BootstrapResult& views);
  // Scale (world over map) of a map that replaces one that is still tracked: the median depth in view is
  // kept.
  std::optional<double> scale_by_depths() const;
  void begin_segment(const ArrivedFrame& now, const NewSegment& begun);
  void record_segment(const Frame& frame, const NewSegment& begun);

  // ---- making a map next to the frames (concurrent_bootstrap.h) ----
  bool waits_for_map() const;
  const FrameRecord& buffer_frame(const Frame& frame, const ImageExposure& exposure);
  BootstrapStatus search_concurrently(const ArrivedFrame& now, const std::optional<LocatedPose>& located);
  void continue_with_map();
  // The reference of the map is an earlier frame; those after it are followed now.
  void begin_made_map();
  void replay_next();
  void replay_at_end();

  // ---- state and records ----
  // Before the first frame, and not earlier: consumers may begin until then.
  void publish_camera();
  void act(const Frame& frame, Action action, const std::string& reason = {});
  void record_newest_pose(const FrameRecord& record);
  void close();
  Run finish();
  FrameView frame_view() const;
  void report(const Frame& frame, const std::string& what) const;

  OdometryParams params;
  OdometryOptions options;
  Pinhole camera, working;
  OdometryState state;
  FrameOrder order;
  ExposureCheck exposures;
  std::shared_ptr<MapLog> log;
  MotionHistory history;
  FrameLog frames;
  MapCursor adjustments;
  MotionConfidence confidence;
  ZoomChange zoom_change;
  double unit_sigma = 0;  // FrameConfidence::unit_sigma of the newest frame
  IntegrityMonitor integrity;
  ScaleComparisons scales;
  FrontEnd front_end;
  EgoMaskMonitor ego_mask_monitor;
  BackwardReplay replay;  // not with `concurrent`
  MapLink map;
  Bootstrapper bootstrapper;
  std::unique_ptr<ConcurrentBootstrap> concurrent;  // only with OdometryOptions::on_schedule
  std::optional<double> scale_of_made;
  bool holds = false;  // buffered frames, for mapping
  std::optional<FeatureTracker> corners;
  std::optional<FocalByCorners> focal;  // with `corners`
  NewestPose newest_pose;
  bool camera_published = false;
  bool frame_published = false;   // the record of the newest frame as it is now
  bool at_zero_velocity = false;  // of a camera that stands, in the newest frame
  bool has_begun_map = false;
  int images_tried = 0;             // to be located, before that
  std::set<int> keyframes_located;  // of the first map
  ImageFault reported_pattern = ImageFault::kNone;
  bool is_closed = false, is_finished = false;
  RealtimeRecord skipped_work;  // once it is closed
};

}  // namespace edgevo
