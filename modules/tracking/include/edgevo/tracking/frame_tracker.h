// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pose of one frame: hypotheses are proposed, one scorer selects, the rows of a rolling shutter are
// accounted for, and the pose gets its covariance.
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/alignment/reference.h"
#include "edgevo/alignment/tracker.h"
#include "edgevo/core/median_motion.h"
#include "edgevo/core/random.h"
#include "edgevo/features/corner_motion.h"
#include "edgevo/tracking/keyframe_policy.h"
#include "edgevo/tracking/motion_model.h"
#include "edgevo/tracking/rolling_shutter.h"
#include "edgevo/tracking/tracking_params.h"

namespace edgevo {

/// All that is known before a frame is tracked. Only the random numbers change.
struct TrackingTask {
  /// Edge pyramid of the frame.
  const FramePyramid& pyramid;
  /// What the frame is tracked against.
  const Reference& reference;
  /// Motion model before the frame.
  const MotionModel& motion;
  /// Median step before the frame, where known.
  std::optional<MedianMotion::Step> median_step;
  /// Keyframe policy before the frame.
  const KeyframePolicy& keyframes;
  /// Parameters of tracking.
  const TrackingParams& params;
  /// How the rows of the frame's image were rectified.
  RowRectification rows;
  /// True if the frame before has no pose.
  bool was_lost = false;
  /// Random numbers of RANSAC.
  Random* random;
  /// Corners that a frame with a pose calls for are left for add_corners().
  bool corners_later = false;
  /// Rotation since the reference by another sensor.
  std::optional<RotationPrior> turn = std::nullopt;
};

/// Rotation that the image alone shows.
struct RotationByImage {
  /// Reference to current camera.
  Eigen::Quaterniond R_cur_ref = Eigen::Quaterniond::Identity();
  /// Covariance of w in R <- exp(w) R.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// The result of tracking a frame.
struct Track {
  /// Pose and its measurements.
  TrackResult result;
  /// What of its rotation the image shows, without TrackingTask::turn.
  RotationByImage by_image;
  /// FrameEvidence::step_sigmas of the pose.
  double step_sigmas = std::numeric_limits<double>::quiet_NaN();
  /// Motion of the camera when the image was taken (edges/image_motion.h).
  Vector6d twist = Vector6d::Zero();
  /// Corners seen in the reference and in this frame; empty unless they were requested and the motion is
  /// large.
  std::vector<CornerPair> corners;
  /// Reference to this frame by these corners, with the expected length; nothing if they give no motion.
  std::optional<SE3> T_by_corners;
  /// True if the pose was selected because the median-motion prior predicted it.
  bool used_median_motion = false;
  /// The pose by the edges, if corners were called for and left for later.
  std::optional<PoseCandidate> wants_corners;
  /// The reference that it was tracked against: without what moves by itself.
  std::shared_ptr<const Reference> scene;
  /// Whether the pose is that of a camera that stands (zero_velocity_update()).
  bool is_zero_velocity = false;
  /// Number of bodies that are known from this frame on to move by themselves.
  int moving_objects = 0;
  /// CPU time of corner tracking in milliseconds; 0: corners were not tracked.
  double corner_ms = 0;
};

/// Estimates the pose of a frame. Cost: usually one alignment of patches and edges, some 3 ms for 1500
/// points.
Track track_frame(const TrackingTask& task);

/// The rest of track_frame() for a frame that wanted corners (Track::wants_corners): the pose with them, and
/// the corners. Equals what it would have found itself. Cost: that of find_corner_motion(), and some
/// alignments.
Track add_corners(const TrackingTask& task, const PoseCandidate& by_edges);

/// The pose T_cur_ref, which is known, with its measurements. Cost: one alignment of edges.
Track zero_velocity_update(const TrackingTask& task, const SE3& T_cur_ref);

/// Image motion that follows from the pose T_cur_ref, `twist` and ImageMotion::turning, with the depths that
/// were expected.
ImageMotion measured_motion(const Pinhole& pinhole, const Reference& reference, const RowRectification& rows,
                            const SE3& T_cur_ref, const Vector6d& twist, const Eigen::Vector3d& turning);

}  // namespace edgevo
