#pragma once
// The mapping side of the odometry: from a bootstrap to a window of keyframes, fed with tracked frames, handing out the reference that
// the next frames are tracked against. One thread at a time; reference() hands out immutable values.
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/random.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/tracking_check.h"
#include "edgevo/mapping/window.h"

namespace edgevo {

/// What a frame is tracked against: the cloud of a keyframe, the newest unless the camera has come back to an older one, and where the
/// window's keyframes stand. Immutable once handed out.
struct Reference {
  int keyframe_id = 0;
  SE3 T_ref_world;
  ReferenceCloud cloud;
  int known_points = 0;                 ///< of the cloud's points, those of known depth
  double view_share = 1;                ///< of all points of the window, those that lie in its image, matched there or not
  double median_idepth = 1;             ///< of the map where the newest keyframe sees it
  std::map<int, SE3> T_keyframe_world;  ///< of all keyframes in the window
  CameraRefinement camera;              ///< that this map was made with
  double error_factor = 1;              ///< variance of poses tracked against it, over the covariance that their alignment tells
};

struct TrackedFrame {
  int frame_index = 0;
  Timestamp time;
  std::shared_ptr<const FramePyramid> pyramid;
  ImageMotion motion;         ///< of its image
  int reference_id = 0;       ///< keyframe that T_cam_ref refers to
  SE3 T_cam_ref;
  Matrix6d covariance = Matrix6d::Zero();
  bool make_keyframe = false;
  std::vector<CornerPair> corners;  ///< seen in its reference keyframe and here; empty unless asked for
  int return_to = -1;         ///< keyframe of the window to track against from now on; -1: the present one
};

/// Milliseconds of CPU time by stage.
using StageTimes = std::vector<std::pair<std::string, double>>;

struct MapUpdate {
  int keyframe_id = -1;       ///< of the keyframe made of this frame; -1 if none
  WindowStats stats;          ///< of the adjustment, if there was one
  StageTimes times;
};

class Mapper {
 public:
  Mapper(const Pinhole& pinhole, const MappingParams& params, const AssociationParams& association, bool gradient_patches,
         uint64_t seed);

  /// Lets be found what the camera file does not say; `rebuild` builds a pyramid anew from its source image, whose motion is given. In a
  /// thread of its own the mapping goes on meanwhile, but when it ends, and with it the result, depends on the machine.
  using RebuildPyramid =
      std::function<std::shared_ptr<const FramePyramid>(const FramePyramid&, const ImageMotion&, const ImageCorrection&)>;
  void enable_self_calibration(const SelfCalibrationParams& params, const RebuildPyramid& rebuild, bool own_thread);

  /// Builds the first window of a segment in the first view's frame, from the two views and up to three between them. Returns an
  /// empty string, or why they make no map.
  [[nodiscard]] std::string initialise(const BootstrapResult& bootstrap);
  /// One tracked frame: updates immature depths, and makes it a keyframe if asked for.
  MapUpdate process(const TrackedFrame& frame);
  /// Closes the segment: all keyframes retire, the window is empty.
  void close();

  std::shared_ptr<const Reference> reference() const { return reference_; }
  const Window& window() const { return window_; }
  int next_id() const { return next_id_; }
  /// Keyframes that have left the window since the last call, with final poses and points, in order of id.
  std::vector<Keyframe> take_retired() { return std::exchange(retired_, {}); }
  /// Keyframes, retired or in the window, that a correction of the camera moved since the last call.
  std::vector<RevisedKeyframe> take_revised() { return std::exchange(revised_, {}); }
  const CameraRefinement& camera() const { return calibration_.state(); }

 private:
  std::vector<ImmaturePoint> first_points(const Keyframe& keyframe, const std::vector<BootstrapCorner>& corners, bool is_last);
  void make_keyframe(const TrackedFrame& frame, const SE3& T_cam_world, MapUpdate* update);
  int new_points_wanted() const;
  void seed_points(Keyframe* keyframe);
  void calibrate_on_the_way();
  void calibrate(bool at_end);
  std::vector<const Keyframe*> window_pointers() const;
  BaOptions calibration_options() const;
  std::shared_ptr<const FramePyramid> corrected(const TrackedFrame& tracked) const;
  void check_tracking(const TrackedFrame& frame);
  void publish(const Keyframe& keyframe);
  void return_to(int keyframe_id);

  Pinhole pinhole_;
  MappingParams params_;
  AssociationParams association_;
  bool gradient_patches_;
  Random random_;
  Window window_;
  std::shared_ptr<const Reference> reference_;
  SelfCalibration calibration_;
  RebuildPyramid rebuild_;
  bool calibration_has_thread_ = false;
  std::vector<Keyframe> retired_;
  std::vector<RevisedKeyframe> revised_;
  int next_id_ = 0;
  TrackingCheck tracking_check_;
  double median_idepth_ = 1;  ///< of the points seen in the newest keyframe
};

/// The keyframe of the window whose view is most like the present one.
struct NearestKeyframe {
  int id = -1;
  double flow_px = 0;        ///< rms image motion of the cloud by the translation from there to here
};
/// Among the keyframes that have `params.min_view_share` of the cloud's visible points in view. Cost: keyframes x 200 projections.
NearestKeyframe find_nearest_keyframe(const Pinhole& pinhole, const Reference& reference, const SE3& T_cam_ref,
                                      const KeyframeParams& params);

/// Is the camera back at another keyframe than its reference? One that is nearer by half, and nearer than keyframes lie to one another; and the
/// reference is left by more than the smallest flow: at a standstill all are equally near.
bool is_back(const Pinhole& pinhole, const NearestKeyframe& nearest, int reference_id, double flow_px, const KeyframeParams& params);

/// How well a reference explains the frames tracked against it, shares in [0, 1].
struct ReferenceFit {
  double matched_share = 1;      ///< AlignmentStats::matched_share() of this frame
  double inlier_share = 1;       ///< PoseEvidence::inlier_share of this frame
  double best_inlier_share = 1;  ///< of all the frames
};

/// Should this frame become a keyframe? The flow is that of the motion from the reference to here or of the motion back, whichever is
/// larger: going forward near things leave the view, going backward as near ones come into it, that the cloud does not know yet.
struct KeyframeDecision {
  bool needed = false;
  double flow_px = 0;        ///< rms image motion of the cloud by the translation alone
  double view_share = 1;     ///< of the cloud, still in view
};
/// Where the view opens (backward motion among near things) a keyframe comes at down to half the flow. Cost: four projections a point.
KeyframeDecision decide_keyframe(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref,
                                 int frames_since_keyframe, const ReferenceFit& fit, const KeyframeParams& params);

}  // namespace edgevo
