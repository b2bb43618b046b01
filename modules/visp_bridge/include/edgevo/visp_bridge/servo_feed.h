// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The odometry as the sensor of a visual-servoing loop.
//
//   odometry thread:  odometry.process(frame);
//                     feed.publish(odometry.newest_pose());       (ServoOdometry does both)
//   servo loop:       const ServoPose pose = feed.pose(now);
//                     if (!pose.usable) robot.setVelocity(CAMERA_FRAME, zero);  // pose.reason says why
//                     else              ... pose.cMw, ServoPoints::features(pose) ...
//
// The loop runs at its own rate: pose() copies the newest result and predicts it at constant velocity to the
// requested time. It never waits for an image. A pose that is missing, lost or too old is not usable, and a
// robot that follows it must stop.
//
// Frames: cMw maps world to camera (x right, y down, z forward), as in ViSP's vpServo examples. The world is
// that of the map: origin at its first keyframe. A goal pose taught by this feed is reached whatever the
// scale; a goal in metres from elsewhere needs a scale (ServoScale). When ServoPose::map_version changes, the
// map is a new one or was corrected for the lens: goals must be taught again. `camera.refine: none`
// (params/servo.yaml) turns correction of the lens off.
//
// A goal of an earlier run: cMk, the camera in the map that was kept of it (ServoOdometry). It stays valid
// over all maps of this run. Until the map of this run is found there, single images are located: a robot
// that follows cMk needs no map to begin.
//
// For what is not fixed to one map: cMo, the camera in `odom`, which goes on smoothly over all maps and
// drifts; and mMo, `odom` in `map` (share/doc/concepts.md, Frames). Both have the axes of the first camera.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpMatrix.h>

#include <limits>
#include <mutex>
#include <optional>
#include <string>

#include "edgevo/core/sim3.h"
#include "edgevo/odometry/newest_pose.h"
#include "edgevo/visp_bridge/kept_map_pose.h"

namespace edgevo {

/// Limits on the age of a pose.
struct ServoFeedOptions {
  /// Largest age of a usable pose.
  double stale_after_s = 0.3;
  /// Longest prediction of a pose.
  double max_prediction_s = 0.3;
  /// Largest interval between two frames from which a velocity is computed.
  double max_step_s = 0.5;
  /// Smallest p_right of a usable pose, 0 to 1; kDoubtfulBelow (core/doubtful_frame.h) stops the robot on
  /// every doubt. A pose of unknown p_right is usable.
  double min_p_right = 0;
};

/// Scale of the map.
struct ServoScale {
  /// Metres per unit of the map, > 0.
  double metres_per_unit = 1;
  /// Standard deviation of metres_per_unit divided by its value; 0: unknown.
  double relative_sigma = 0;
  /// Description of the source of the scale; "none": the unit is arbitrary.
  std::string source = "none";

  /// Whether lengths are metres.
  bool is_metric() const { return source != "none"; }
};

/// The newest pose, predicted to the time of the loop.
struct ServoPose {
  /// Whether the pose in the map, cMw, may be used; if not, a robot that follows it must stop.
  bool usable = false;
  /// Reason why it may not, for people.
  std::string reason;
  /// Whether the pose in the kept map, cMk, may be used; if not, a robot that follows it must stop.
  bool usable_in_kept = false;
  /// Whether cMk is that of the newest image by itself (kept_map_pose.h): the map of this run is not found in
  /// the kept one, or an image contradicts it.
  bool is_kept_by_image = false;
  /// Tracking state of the newest frame.
  TrackingState state = TrackingState::kBootstrapping;
  /// Probability that the motion around the newest frame is right (NewestPose::p_right); NaN: unknown.
  double p_right = std::numeric_limits<double>::quiet_NaN();
  /// Index of the newest frame; -1: none.
  int frame_index = -1;
  /// Time of the newest frame.
  Timestamp time;
  /// Requested time minus time of the newest frame.
  double age_s = 0;
  /// Part of the age that cMw is predicted over.
  double predicted_s = 0;
  /// World to camera at the requested time; translation scaled by scale.metres_per_unit.
  vpHomogeneousMatrix cMw;
  /// World to camera at the time of the newest frame, not predicted; same unit as cMw.
  vpHomogeneousMatrix cMw_at_image;
  /// Covariance (6x6) of xi in cMw <- exp(xi) cMw, [v, w] in the camera frame, with the nearby map and the
  /// scale taken as known. Grows with the prediction. All zero: unknown.
  vpMatrix covariance;
  /// `odom` to camera at the requested time; same unit as cMw. Smooth over all maps, unless the unit becomes
  /// metres, and it drifts.
  vpHomogeneousMatrix cMo;
  /// `odom` to `map`, where things lie by what is known: rigid, the identity until something is found about
  /// the past. Same unit as cMw.
  vpHomogeneousMatrix mMo;
  /// Kept map to camera, in the unit of that map whatever `scale` is: at the requested time, or at that of
  /// the newest frame if that was located by itself. Nothing: no such map, or the camera is not found in it.
  std::optional<vpHomogeneousMatrix> cMk;
  /// Number of changes of mMo by what was found so far.
  int map_changes = 0;
  /// Version of the map. Poses and points of different versions must not be mixed.
  int map_version = 0;
  /// Scale of all lengths.
  ServoScale scale;
  /// Result of the odometry in map units, for ServoPoints.
  NewestPose view;
};

/// Passes poses from the thread of the odometry to that of the loop.
class ServoFeed {
 public:
  /// Makes a feed that has no pose yet.
  explicit ServoFeed(const ServoFeedOptions& options = {}) : options_(options) {}

  /// Publishes the result of the newest frame, and where that is in a map that was kept. Any thread; takes
  /// microseconds.
  void publish(const NewestPose& view, const KeptMapPose& kept = {});
  /// Sets the scale of the present map: lengths are in metres from now on. A later map has the scale that its
  /// unit has in `odom`. Another scale leaves the newest pose in `odom` where it is. Throws InputError unless
  /// it is positive and finite.
  void set_scale(const ServoScale& scale);
  /// Reports that the odometry has ended with this message; no pose is usable from now on.
  void fail(const std::string& message);

  /// The newest pose, predicted to time `now` of the clock that stamps the images. Any thread; takes
  /// microseconds.
  ServoPose pose(Timestamp now) const;

 private:
  ServoFeedOptions options_;
  /// Held while copying only.
  mutable std::mutex mutex_;
  NewestPose newest_;
  KeptMapPose kept_;
  /// Velocity per second, map units: T_cam_map <- exp(velocity dt) T_cam_map.
  Vector6d velocity_ = Vector6d::Zero();
  /// Interval that the velocity was measured over; 0: there is none.
  double step_s_ = 0;
  int map_version_ = 0;
  /// Of the newest map.
  double last_odom_scale_ = 1;
  ServoScale scale_;
  /// From `odom` in the unit of the odometry to that in metres.
  Sim3 to_metres_;
  std::string failure_;
};

}  // namespace edgevo
