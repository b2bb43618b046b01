#pragma once
// The mapping side of the odometry: from a bootstrap to a window of keyframes, fed with tracked frames,
// handing out the reference that the next frames are tracked against. One thread at a time; reference() hands
// out immutable values.
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/edge_map/edge_mapper.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/window.h"
#include "edgevo/odometry/odometry_params.h"
#include "edgevo/odometry/reference.h"
#include "edgevo/odometry/tracking_check.h"
#include "edgevo/self_calibration/self_calibration.h"

namespace edgevo {

/// A frame with its pose, handed from tracking to mapping.
struct TrackedFrame {
  int frame_index = 0;                          ///< in the source
  Timestamp time;                               ///< of the frame
  std::shared_ptr<const FramePyramid> pyramid;  ///< of its image
  ImageMotion motion;                           ///< of its image
  int reference_id = 0;                         ///< keyframe that T_cam_ref refers to
  SE3 T_cam_ref;                                ///< keyframe `reference_id` to this camera
  Matrix6d covariance = Matrix6d::Zero();       ///< of xi in T_cam_ref <- exp(xi) T_cam_ref, tangent [v, w]
  bool make_keyframe = false;                   ///< keyframe_policy.h called for it
  std::vector<CornerPair> corners;  ///< seen in its reference keyframe and here; empty unless requested
  int return_to = -1;  ///< keyframe of the window to track against from now on; -1: the present one
};

/// Milliseconds of CPU time by stage.
using StageTimes = std::vector<std::pair<std::string, double>>;

/// What mapping made of a frame.
struct MapUpdate {
  int keyframe_id = -1;  ///< of the keyframe made of this frame; -1 if none
  WindowStats stats;     ///< of the adjustment, if there was one
  StageTimes times;      ///< of the stages that ran
};

/// Builds a pyramid again from its source image, whose motion is given, for another correction of the camera.
using RebuildPyramid = std::function<std::shared_ptr<const FramePyramid>(
    const FramePyramid&, const ImageMotion&, const ImageCorrection&)>;

/// How the mapping of a run works; what it estimates is in OdometryParams.
struct MapperOptions {
  /// Of the run.
  uint64_t seed = 1;
  /// Self-calibration and edge map in threads of their own: mapping goes on meanwhile, but when they end, and
  /// with it the result, depends on the machine. Keyframes may be left out of the edge map.
  bool own_threads = false;
  /// Needed with self-calibration.
  RebuildPyramid rebuild;
};

/// Window, self-calibration and edge map of a run.
class Mapper {
 public:
  Mapper(const Pinhole& pinhole, const OdometryParams& params, const MapperOptions& options);

  /// Builds the first window of a segment in the first view's frame, from the two views and up to three
  /// between them. Returns an empty string, or why they make no map.
  [[nodiscard]] std::string initialise(const BootstrapResult& bootstrap);
  /// One tracked frame: updates immature depths, and makes it a keyframe if requested.
  MapUpdate process(const TrackedFrame& frame);
  /// Closes the segment: all keyframes retire, the window is empty.
  void close();

  std::shared_ptr<const Reference> reference() const { return reference_; }  ///< null without a map
  const Window& window() const { return window_; }                           ///< empty without a map
  int next_id() const { return next_id_; }  ///< of the keyframe that comes next; ascends over the whole run
  /// Keyframes that have left the window since the last call, with final poses and points, in order of id.
  std::vector<Keyframe> take_retired() { return std::exchange(retired_, {}); }
  /// Keyframes, retired or in the window, that a correction of the camera moved since the last call.
  std::vector<RevisedKeyframe> take_revised() { return std::exchange(revised_, {}); }
  /// what self-calibration found so far
  const CameraRefinement& camera() const { return calibration_.state(); }
  /// Of the segments closed since the last call.
  std::vector<HostedLines> take_lines() { return std::exchange(lines_, {}); }

 private:
  // The steps of a bootstrap.
  void add_first_keyframes(const BootstrapResult& bootstrap);
  std::vector<ImmaturePoint> first_points(const Keyframe& keyframe,
                                          const std::vector<BootstrapCorner>& corners, bool is_last);
  void filter_first_depths(const BootstrapResult& bootstrap);
  // The steps of a frame.
  TrackedFrame corrected(const TrackedFrame& tracked) const;
  void filter_depths(const TrackedFrame& frame, const SE3& T_cam_world, StageTimes* times);
  void return_to(int keyframe_id, StageTimes* times);
  void make_keyframe(const TrackedFrame& frame, const SE3& T_cam_world, MapUpdate* update);
  // The steps of a keyframe.
  void add_keyframe(const TrackedFrame& frame, const SE3& T_cam_world);
  void associate(const TrackedFrame& frame, StageTimes* times);
  void activate_points(StageTimes* times);
  WindowStats adjust(StageTimes* times);
  void check_tracking(const TrackedFrame& frame);
  void remove_oldest(StageTimes* times);
  void map_edges(StageTimes* times);
  void calibrate_if_due(StageTimes* times);
  void seed_and_publish(StageTimes* times);

  void smooth_depths();
  int new_points_wanted() const;
  void drop_old_points();
  void seed_points(Keyframe* keyframe);
  void calibrate_on_the_way();
  void calibrate(bool at_end);
  std::vector<const Keyframe*> window_pointers() const;
  BaOptions calibration_options() const;
  void publish(const Keyframe& keyframe);

  Pinhole pinhole_;
  MappingParams params_;
  AssociationParams association_;
  bool gradient_patches_;
  MapperOptions options_;
  Random random_;
  Window window_;
  std::shared_ptr<const Reference> reference_;
  SelfCalibration calibration_;
  EdgeMapper edge_mapper_;
  std::vector<Keyframe> retired_;
  std::vector<HostedLines> lines_;
  std::vector<RevisedKeyframe> revised_;
  int next_id_ = 0;
  TrackingCheck tracking_check_;
  double median_idepth_ = 1;  ///< of the points seen in the newest keyframe
};

}  // namespace edgevo
