#pragma once
// The pose of one frame: hypotheses are proposed, one judge chooses, the rows of a rolling shutter are
// accounted for, and the pose gets its covariance and verdict.
#include <optional>
#include <vector>

#include "edgevo/alignment/tracker.h"
#include "edgevo/core/random.h"
#include "edgevo/mapping/corner_motion.h"
#include "edgevo/odometry/odometry_params.h"
#include "edgevo/odometry/reference.h"
#include "keyframe_policy.h"
#include "motion_model.h"
#include "rolling_shutter.h"

namespace edgevo {

/// All that is known before a frame is tracked. Nothing in it changes but the random numbers.
struct TrackingTask {
  const FramePyramid& pyramid;
  const Reference& reference;
  const MotionModel& motion;
  const KeyframePolicy& keyframes;
  const OdometryParams& params;
  RowRectification rows;
  bool was_lost = false;  ///< the frame before has no pose
  Random* random;         ///< for RANSAC
};

/// A frame as it was tracked.
struct Track {
  TrackResult result;
  Vector6d twist =
      Vector6d::Zero();  ///< how the camera moved when the image was taken (edges/image_motion.h)
  std::vector<CornerPair>
      corners;  ///< seen in the reference and here; empty unless requested, and the motion is large
  bool took_usual_step = false;  ///< the pose is near the usual step because that was expected
  double corner_ms = 0;          ///< CPU time of asking the corners, 0: they were not
};

/// Cost: one alignment of patches and edges as a rule, some 3 ms for 1500 points.
Track track_frame(const TrackingTask& task);

/// The motion of the image as the pose T_cur_ref and `twist` have it, with the depths that were expected.
ImageMotion measured_motion(const Pinhole& pinhole, const Reference& reference, const RowRectification& rows,
                            const SE3& T_cur_ref, const Vector6d& twist);

}  // namespace edgevo
