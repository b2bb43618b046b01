// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From an image to a pose: edges, tracking against the reference, and the frame that mapping receives. Knows
// no state and no map but the reference.
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "edgevo/confidence/correlated_residual_mean.h"
#include "edgevo/core/image.h"
#include "edgevo/core/motion_history.h"
#include "edgevo/core/random.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/gyro/gyro_aid.h"
#include "edgevo/mapping/mapper.h"
#include "edgevo/segmentation/moving_objects.h"
#include "edgevo/segmentation/stationary_detector.h"
#include "edgevo/segmentation/view_masks.h"
#include "edgevo/tracking/corner_search.h"
#include "edgevo/tracking/frame_tracker.h"
#include "edgevo/tracking/frame_view.h"
#include "edgevo/tracking/keyframe_policy.h"
#include "edgevo/tracking/map_coverage.h"
#include "edgevo/tracking/motion_model.h"
#include "edgevo/tracking/rolling_shutter.h"
#include "edgevo/tracking/tracking_params.h"

namespace edgevo {

/// How tracking works in a run; what it estimates is in TrackingParams.
struct TrackingOptions {
  /// Seed of the run.
  uint64_t seed = 1;
  /// Detectors that EdgeParams::detector may name.
  EdgeDetectorTable detectors = basic_edge_detectors();
  /// Corners are searched next to the frames (corner_search.h).
  bool corners_in_parallel = false;
};

/// A frame while it is processed.
struct ArrivedFrame {
  /// Image and time; must outlive this.
  const Frame& frame;
  /// Its edge pyramid.
  std::shared_ptr<const FramePyramid> pyramid;
  /// How the rows of its image were rectified.
  RowRectification rows;
  /// What the images up to it show without a pose (ViewMasks).
  StillCells still;
  /// Whether a part of its view may be fixed to the camera.
  bool may_show_ego_part = false;
  /// Record of the frame; null until it is begun.
  FrameRecord* record = nullptr;
};

/// Edges, pose and keyframe decision of each frame; for the tracking thread.
class FrontEnd {
 public:
  /// `history`, which must outlive this object, gets each frame whose pose is accepted. Throws InputError for
  /// an unusable camera or detector.
  FrontEnd(const Rectification& rectification, const TrackingParams& params, const TrackingOptions& options,
           MotionHistory* history);

  /// Takes a sample of a gyro. Those up to a frame, and some tenths of a second after it, come before it.
  void add(const GyroSample& sample) { gyro_.add(sample); }
  /// The gyro next to the camera.
  GyroAid& gyro() { return gyro_; }
  /// Where a frame without a pose looks, by the gyro: the turn from the frame of the map to it, whose
  /// covariance is that since the last pose. Nothing if no gyro has followed it.
  std::optional<CameraTurn> heading() const;
  /// Must be called first for each frame, also for one that is skipped.
  void begin_frame(Timestamp time);
  /// Finds the edges of a frame; its rows are rectified for the expected motion if the frame before has a
  /// pose. Leaves `record` null. Throws InputError for an image of another size.
  /// `exposure`: what its pixels show of its exposure.
  ArrivedFrame find_edges(const Frame& frame, bool has_pose, const ImageExposure& exposure = {});
  /// An earlier frame, which has no pose, with the masks of the newest one, and all of its levels.
  std::shared_ptr<const FramePyramid> masked_anew(const std::shared_ptr<const FramePyramid>& earlier) {
    const ImageMasks newest{newest_pyramid_->border_mask, newest_pyramid_->ego_mask};
    const bool is_same = earlier->ego_mask == newest.ego && !earlier->levels.empty();
    return is_same ? earlier : builder_.rebuild(*earlier, {}, newest);
  }
  /// Finds the pose of a frame against the reference. Writes times and evidence to its record; straightens
  /// its rows again if the gyro by which that was done is contradicted.
  Track find_pose(ArrivedFrame* now, bool was_lost);
  /// Motion from the last frame with a pose to one at T_cur_ref.
  SE3 motion_to(const SE3& T_cur_ref) const { return motion_.motion_to(T_cur_ref); }
  /// Why the step to a pose is not believed, whatever its support; nothing where it is.
  std::optional<Reason> step_gate(const SE3& T_cur_ref) const;
  /// Whether the map is in view (MapCoverage::look).
  MapInView look(const FrameEvidence& evidence) { return coverage_.look(evidence); }
  /// Accepts the pose of a frame and returns what mapping needs of it. Writes a call for a keyframe to its
  /// record.
  TrackedFrame accept_pose(const ArrivedFrame& now, Track track, bool is_mapping_busy);
  /// Shows the gyro the rotation of the accepted pose: of one that is not doubtful. The edges of a map that
  /// is bent fit, and turn wrongly.
  void confirm_turn();
  /// Says that what the accepted pose is doubted for, if it is, is nothing that a wrong gyro causes: how much
  /// of the unit of length a turn has carried on. The next frame is not seen again without it for that.
  void believe_gyro() { in_doubt_ = false; }

  /// Reference that frames are tracked against; null without a map.
  const std::shared_ptr<const Reference>& reference() const { return reference_; }
  /// What moves by itself in the newest frame.
  MovingAreas moving_areas() const { return bodies_.areas(); }
  /// Adopts a new reference from mapping, for whose correction the builder has been set: expresses the last
  /// pose against it.
  void change_reference(std::shared_ptr<const Reference> newest);
  /// Adopts the map of a new segment, whose reference is the newest frame. `motion` is the motion since the
  /// frame before, where known.
  void begin_map(std::shared_ptr<const Reference> reference, const std::optional<SE3>& motion);
  /// The same for a map whose reference is an earlier frame, of that time: those after it are begun again.
  void begin_map(std::shared_ptr<const Reference> reference, const std::optional<SE3>& motion,
                 Timestamp time) {
    begin_map(std::move(reference), motion);
    motion_.set_clock_back(time);
    pose_time_ = time;
  }
  /// Drops the reference: there is no map any more.
  void drop_map() { reference_.reset(); }

  /// Parameters of tracking.
  const TrackingParams& params() const { return params_; }
  /// What builds the images.
  PyramidBuilder& builder() { return builder_; }
  /// Cameras of the raw and of the working images.
  const Rectification& rectification() const { return rectification_; }
  /// Correction that is applied to the images.
  ImageCorrection correction() const { return builder_.correction(); }
  /// Applies another correction from the next image on.
  void set_correction(const ImageCorrection& correction) { builder_.set_correction(correction); }
  /// Frames in a row that would have become keyframes had mapping not been busy.
  int postponed_keyframes() const { return keyframes_.postponed(); }
  /// Pyramid of the newest frame; null before the first.
  const std::shared_ptr<const FramePyramid>& newest_pyramid() const { return newest_pyramid_; }
  /// View of the map from the newest frame, which must have a pose. `idepth_factor`: inverse depth in the
  /// world over inverse depth in the map.
  FrameView view(double idepth_factor) const;

 private:
  ImageMotion expected_motion(bool has_pose) const;
  // What two images show of the rotation between them.
  struct ImageTurn {
    Timestamp begin, end;
    Eigen::Quaterniond R;
    Eigen::Matrix3d covariance;
  };
  std::optional<RotationPrior> turn_since_reference(Timestamp time) const;
  void see_turn(const ArrivedFrame& now, const Track& track);
  std::optional<CornerJob> corner_job(const ArrivedFrame& now, const Track& track) const;
  TrackingTask task(const ArrivedFrame& now, const Reference& scene, bool was_lost);
  Track track_scene(ArrivedFrame* now, bool was_lost);
  bool contradicts_gyro(const ArrivedFrame& now, const Track& found) const;
  void doubt_gyro(const Reference& scene, bool was_lost, ArrivedFrame* now, Track* found);
  void update_zero_velocity(const ArrivedFrame& now, bool was_lost, Track* found);
  void follow(const ArrivedFrame& now, const Track& track);
  void rectify_keyframe(const ArrivedFrame& now, const Vector6d& twist, TrackedFrame* tracked);

  TrackingParams params_;
  Rectification rectification_;
  PyramidBuilder builder_;
  ViewMasks masks_;
  Random random_;                                      // for corners
  std::unique_ptr<CornerSearch> corners_in_parallel_;  // only with TrackingOptions::corners_in_parallel
  MotionModel motion_;
  GyroAid gyro_;
  std::optional<ImageTurn> seen_turn_;     // until the pose is confirmed
  bool in_doubt_ = false;                  // the newest frame: a wrong gyro may have bent it
  Timestamp begun_, pose_time_;            // of the newest frame, and of the last one with a pose
  std::optional<RotationByImage> turned_;  // of that one
  MotionHistory* history_;
  KeyframePolicy keyframes_;
  MapCoverage coverage_;
  MovingObjects bodies_;
  StationaryDetector stationary_;
  CorrelatedResidualMean correlated_residual_;
  std::shared_ptr<const Reference> reference_;
  std::shared_ptr<const FramePyramid> newest_pyramid_;
};

}  // namespace edgevo
