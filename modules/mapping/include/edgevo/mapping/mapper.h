// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The mapping side of the odometry: from a bootstrap to a window of keyframes, fed with tracked frames.
// Publishes the reference that the next frames are tracked against, and the events of the map. One thread at
// a time; what other threads see are immutable values: reference() and the events.
#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/confidence/tracking_check.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/core/random.h"
#include "edgevo/edge_map/edge_mapper.h"
#include "edgevo/map/map.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/idepth_prior.h"
#include "edgevo/mapping/shedding.h"
#include "edgevo/mapping/window.h"
#include "edgevo/segmentation/moving_areas.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

class RebuiltImages;

/// What corners that are searched next to the frames make of a pose.
struct PoseByCorners {
  /// TrackedFrame::T_cam_ref with their help.
  SE3 T_cam_ref;
  /// Its covariance.
  Matrix6d covariance = Matrix6d::Zero();
  /// The corners that agree; empty if they give no motion.
  std::vector<CornerPair> corners;
  /// CPU time of the search, milliseconds.
  double cpu_ms = 0;
};

/// A frame with its pose, passed from tracking to mapping.
struct TrackedFrame {
  /// Index of the frame in the source.
  int frame_index = 0;
  /// Timestamp of the frame.
  Timestamp time;
  /// Edge pyramid of the image.
  std::shared_ptr<const FramePyramid> pyramid;
  /// Motion of the image while it was taken.
  ImageMotion motion;
  /// Keyframe that T_cam_ref refers to.
  int reference_id = 0;
  /// Motion from keyframe `reference_id` to this camera.
  SE3 T_cam_ref;
  /// Covariance of xi in T_cam_ref <- exp(xi) T_cam_ref, tangent [v, w].
  Matrix6d covariance = Matrix6d::Zero();
  /// True if the frame is to become a keyframe (keyframe_policy.h).
  bool make_keyframe = false;
  /// Corners seen in the reference keyframe and in this frame; empty unless requested.
  std::vector<CornerPair> corners;
  /// Rotation from keyframe `reference_id` by another sensor.
  std::optional<KeyframeTurn> turn = std::nullopt;
  /// What replaces pose, covariance and corners once it is there; mapping waits for it. Invalid: nothing
  /// does.
  std::shared_future<PoseByCorners> by_corners;
  /// What moves by itself: no points are made there, and those that were are dropped.
  MovingAreas moving;
  /// Keyframe of the window to track against from now on; -1: the present one.
  int return_to = -1;
  /// Whether the motion is in doubt (integrity_monitor.h): what is mapped is provisional.
  bool is_in_doubt = false;
  /// What corners show of the focal length up to this frame.
  std::optional<FocalError> focal_length;
  /// Whether a doubt has ended, and the keyframes made in it count from now on.
  bool confirms_map = false;

  /// Whether mapping must not skip the frame.
  bool is_needed() const { return make_keyframe || confirms_map; }
};

/// Result of mapping a frame.
struct MapUpdate {
  /// Id of the keyframe made of this frame; -1: none.
  int keyframe_id = -1;
  /// Statistics of the adjustment, if there was one.
  WindowStats stats;
  /// What the adjustment showed about the new keyframe; nothing if there was none or it failed.
  std::optional<AdjustmentEvidence> adjustment;
  /// CPU times of the stages that ran.
  StageTimes times;
};

/// Rebuilds a pyramid from its source image, whose motion is given, for another correction of the camera.
using RebuildPyramid = std::function<std::shared_ptr<const FramePyramid>(
    const FramePyramid&, const ImageMotion&, const ImageCorrection&)>;

/// Proposes a move of the map; nothing to leave it as it is.
using MoveMap = std::function<std::optional<MapMoved>(const Map&)>;

/// What a Mapper estimates, and how.
struct MapperParams {
  /// Bootstrap, points and window.
  MappingParams mapping;
  /// Matches between keyframes.
  AssociationParams association;
  /// Camera properties that the camera file does not contain.
  SelfCalibrationParams camera;
  /// Map of lines.
  EdgeMapParams edge_map;
  /// How frames are aligned, and when the image supports their poses.
  ViewAlignment tracking;
};

/// How mapping works in a run; what it estimates is in MapperParams.
struct MapperOptions {
  /// Seed of the run.
  uint64_t seed = 1;
  /// Self-calibration and edge map run in threads of their own: mapping continues meanwhile, but when they
  /// end, and with it the result, depends on the machine. The edge map may skip keyframes.
  bool own_threads = false;
  /// Rebuilds pyramids; required with self-calibration.
  RebuildPyramid rebuild;
  /// Receives the events of the map; null: nobody follows it.
  std::shared_ptr<MapLog> log;
  /// Called once per keyframe, after self-calibration; may be empty.
  MoveMap move_map;
  /// What the events report leaves the memory.
  bool forget = false;
  /// SelfCalibration::begin_with(); nothing: with the parameters.
  std::optional<CameraPosterior> camera = std::nullopt;
};

/// Map, window, self-calibration and edge lines of a run.
class Mapper {
 public:
  /// Starts without a map. Throws InputError for a solver of
  /// another name.
  Mapper(const Rectification& rectification, const MapperParams& params, const MapperOptions& options);
  ~Mapper();

  /// Builds the first window of a segment in the first view's frame, from the two views and up to three
  /// between them. Returns nothing, or why they make no map.
  [[nodiscard]] Reasons initialise(const BootstrapResult& bootstrap);
  /// Announces the first window as that of `segment`, whose pose has been announced.
  void begin_segment(int segment) { map_->begin_segment(segment); }
  /// Processes one tracked frame: updates immature depths, and makes it a keyframe if requested.
  MapUpdate process(const TrackedFrame& frame);
  /// Closes the segment: marginalises all keyframes and empties the window.
  void close();

  /// What is skipped from now on. From any thread.
  void shed(Shedding shedding) { shedding_ = shedding; }
  /// What was skipped: lines and points.
  const ShedWork& shed_work() const { return shed_work_; }

  /// Reference that frames are tracked against; null without a map.
  std::shared_ptr<const Reference> reference() const { return reference_; }
  /// The window of keyframes; empty without a map.
  const Window& window() const { return window_; }
  /// All keyframes.
  const Map& map() const { return *map_; }
  /// Id of the next keyframe; ascends over the whole run.
  int next_id() const { return next_id_; }
  /// Self-calibration so far.
  const CameraPosterior& camera() const { return calibration_.state(); }

 private:
  // The steps of a bootstrap.
  void add_first_keyframes(const BootstrapResult& bootstrap);
  std::vector<ImmaturePoint> first_points(const Keyframe& keyframe,
                                          const std::vector<BootstrapCorner>& corners, bool is_last);
  void filter_first_depths(const BootstrapResult& bootstrap);
  // The steps of a frame.
  static TrackedFrame with_corners(TrackedFrame frame, StageTimes* times);
  TrackedFrame corrected(const TrackedFrame& tracked) const;
  void drop_moving_points(const TrackedFrame& frame, const SE3& T_cam_world);
  void filter_depths(const TrackedFrame& frame, const SE3& T_cam_world, StageTimes* times);
  void return_to(int keyframe_id, StageTimes* times);
  void make_keyframe(const TrackedFrame& frame, const SE3& T_cam_world, MapUpdate* update);
  void note_doubt(const TrackedFrame& frame);
  void confirm();
  // The steps of a keyframe.
  void add_keyframe(const TrackedFrame& frame, const SE3& T_cam_world);
  void associate(const TrackedFrame& frame, StageTimes* times);
  void activate_points(StageTimes* times);
  WindowStats adjust(StageTimes* times);
  double check_tracking(const TrackedFrame& frame);
  void remove_oldest(StageTimes* times);
  void map_edges(StageTimes* times);
  void show_edges(const TrackedFrame& frame, StageTimes* times);
  void calibrate_if_due(StageTimes* times);
  void move_if_proposed();
  void seed_and_publish(StageTimes* times);

  void smooth_depths();
  int new_points_wanted() const;
  void drop_old_points();
  void seed_points(Keyframe* keyframe);
  void calibrate_during_run();
  void calibrate_concurrently();
  void correct_between_keyframes(StageTimes* times);
  bool is_prepared(const ImageCorrection& correction);
  void end_concurrent_calibration();
  void calibrate(bool at_end);
  void move_map(MapMoved moved);
  void evict();
  BaOptions calibration_options() const;
  void publish(const Keyframe& keyframe);
  void publish_again();

  Rectification rectification_;
  Pinhole pinhole_;
  CellGrid cells_;  // that get one new point each
  MappingParams params_;
  AssociationParams association_;
  bool gradient_patches_;
  MapperOptions options_;
  Random random_;
  std::shared_ptr<MapLog> log_;
  std::unique_ptr<Map> map_;  // the window keeps its address
  Window window_;
  std::shared_ptr<const Reference> reference_;
  SelfCalibration calibration_;
  EdgeMapper edge_mapper_;
  std::unique_ptr<RebuiltImages> corrected_images_;
  int keyframes_prepared_ = 0;  // since the preparation of a correction began; 0: none
  std::atomic<Shedding> shedding_{Shedding::kNothing};
  ShedWork shed_work_;
  MovingAreas moving_;  // in the newest frame
  int next_id_ = 0;
  TrackingCheck tracking_check_;
  /// Depths seen up to the newest keyframe.
  SeenIdepths seen_idepths_;
};

}  // namespace edgevo
