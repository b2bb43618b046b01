// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The motion of the last frames: how long a step usually is, and the motion over ten frames.
//
// A step is the translation from one frame to the next. It has two lengths, since they are not the same
// number, and each question needs its own:
//
//   measured   by the alignment, against one reference. An adjustment of keyframes is no motion. Over a gap
//              the mean of its frames by the clock; a step of less than a tenth of the usual one is that of
//              a camera that stands, and does not count. Unit of the map.
//   in map     between two poses as they were stored, so that an adjustment between them is part of it. None
//              over a gap; a frame that is known to stand (FrameEvidence::stands) does not count. Unit of
//              the map.
#include <deque>
#include <limits>
#include <optional>

#include "edgevo/core/median_motion.h"
#include "edgevo/core/motion_tolerance.h"
#include "edgevo/core/recent_values.h"
#include "edgevo/core/records.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// The last frames' motion in a run; for the tracking thread. Cost: some microseconds a frame.
class MotionHistory {
 public:
  /// A frame that has been tracked.
  struct Tracked {
    /// Pose in the segment's map, in its unit.
    SE3 T_map_cam;
    /// Motion since the last frame with a pose, as measured.
    SE3 T_cur_last = {};
    /// Frame intervals of that motion, by the clock: 1 if no frame is missing.
    int frames = 1;
    /// FrameEvidence::stands.
    bool stands = false;
    /// The median step decided on the pose (MedianMotion::follow).
    bool held = false;
  };
  /// How the newest tracked frame moved, and what was usual: steps in the map, its unit, NaN where unknown.
  struct Newest {
    /// Since the frame before.
    double step = std::numeric_limits<double>::quiet_NaN();
    /// Median of the last 50, its own among them.
    double usual = std::numeric_limits<double>::quiet_NaN();
    /// Rotation over the last ten frames, as far as they are known; radians.
    double turn_rad = 0;
    /// Translation over the same frames.
    double length = 0;
    /// Length of its difference to the translation that was measured from frame to frame: by so much
    /// adjustments of keyframes have moved the camera meanwhile.
    double moved_by_map = 0;
  };

  /// Adds a frame that has been tracked, in time order.
  void add(const Tracked& frame);
  /// A frame has no pose: the next step in the map has no length.
  void interrupt() { poses_.clear(), T_cam_path_ = {}; }
  /// A new map, in another unit.
  void begin_map();

  /// Largest measured step that is believed: `times` the usual one (the median of the last 50), the one
  /// before, or kSmallStep of `median_depth`, whichever is the largest. Infinite until ten are known.
  double largest_step(double times, double median_depth) const;
  /// Measured translation of points in the camera's axes at the usual speed (that median), in the direction
  /// of the last step that counts; 0 until ten are known.
  Eigen::Vector3d typical_step() const;
  /// Median and spread of the measured steps, axis by axis.
  std::optional<MedianMotion::Step> median_step() const { return median_motion_.median_step(); }
  /// The newest tracked frame.
  const Newest& newest() const { return newest_; }
  /// Steps of which the median is usual.
  static constexpr size_t kUsualSteps = 50;

 private:
  void add_measured(const SE3& T_cur_last, int frames, bool held);
  void add_in_map(const SE3& T_map_cam, bool stands);

  RecentValues measured_{kUsualSteps}, in_map_{kUsualSteps};
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();  // of the last measured step that counts
  MedianMotion median_motion_;
  struct Placed {
    SE3 T_map_cam, T_cam_path;
  };
  std::deque<Placed> poses_;  // of the last ten frames in a row, and the one before them
  SE3 T_cam_path_;            // the measured motions of these frames, one after the other
  Newest newest_;
};

}  // namespace edgevo
