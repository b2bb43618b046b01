#pragma once
// The odometry as the sensor of a visual-servoing loop.
//
//   odometry thread:  odometry.process(frame);
//                     feed.publish(odometry.newest_pose());       (ServoOdometry does both)
//   servo loop:       const ServoPose pose = feed.pose(now);
//                     if (!pose.usable) robot.setVelocity(CAMERA_FRAME, zero);  // pose.reason tells why
//                     else              ... pose.cMw, ServoPoints::features(pose) ...
//
// The loop runs at its own rate: pose() copies the newest result and carries it on at constant velocity to
// the time it is asked for. It never waits for an image. A pose that is too old, lost, or not there is not
// usable, and a robot that follows it must stop.
//
// Frames: cMw maps world to camera (x right, y down, z forward), as vpServo examples use it. The world is the
// map's: origin at its first keyframe. A goal pose taught by this feed and reached by this feed is reached
// whatever the scale; a goal in metres from elsewhere needs a scale (ServoScale). When ServoPose::map_version
// changes, the map is a new one or was corrected for the lens: what was taught in the old one must be taught
// again. `camera.refine: none` (params/servo.yaml) leaves the lens alone.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpMatrix.h>

#include <mutex>
#include <string>

#include "edgevo/odometry/newest_pose.h"

namespace edgevo {

/// When a pose is too old.
struct ServoFeedOptions {
  double stale_after_s = 0.3;     ///< a pose older than this is not usable
  double max_prediction_s = 0.3;  ///< a pose is carried on for no longer than this
  double max_step_s = 0.5;        ///< two frames further apart than this do not make a velocity
};

/// What a length of the map is in metres.
struct ServoScale {
  double metres_per_unit = 1;  ///< > 0
  double relative_sigma = 0;    ///< one standard deviation over the value; 0: unknown
  std::string source = "none";  ///< "none": the unit is arbitrary

  bool is_metric() const { return source != "none"; }  ///< lengths are metres
};

/// The newest pose, at the time of the loop.
struct ServoPose {
  bool usable = false;  ///< false: the robot must stop
  std::string reason;  ///< why it is not usable; for a person
  TrackingState state = TrackingState::kBootstrapping;  ///< of the newest frame
  int frame_index = -1;     ///< of the image
  Timestamp time;           ///< of the image
  double age_s = 0;         ///< asked for this much later
  double predicted_s = 0;   ///< of the age, this much is in cMw
  vpHomogeneousMatrix cMw;  ///< at the time asked for; translation in scale.metres_per_unit x map units
  vpHomogeneousMatrix cMw_at_image;  ///< the same at the time of the image, not predicted
  /// 6x6 of xi in cMw <- exp(xi) cMw, [v, w] in the camera frame, against the map nearby and the scale taken as known; grows with the
  /// prediction. All zero: unknown.
  vpMatrix covariance;
  int map_version = 0;  ///< poses and points of different versions must not be mixed
  ServoScale scale;  ///< of all lengths
  NewestPose view;  ///< in map units: for ServoPoints
};

/// Between the thread of the odometry and that of the loop.
class ServoFeed {
 public:
  explicit ServoFeed(const ServoFeedOptions& options = {}) : options_(options) {}  ///< without a pose yet

  /// The newest frame's result. Any thread; takes microseconds.
  void publish(const NewestPose& view);
  /// From now on lengths are in metres. Throws InputError for a value that is not positive and finite.
  void set_scale(const ServoScale& scale);
  /// The odometry has ended, with this message; no pose is usable any more.
  void fail(const std::string& message);

  /// The newest pose at time `now`, of the clock that the images are stamped with. Any thread; takes
  /// microseconds.
  ServoPose pose(Timestamp now) const;

 private:
  ServoFeedOptions options_;
  mutable std::mutex mutex_;  ///< held for a copy only
  NewestPose newest_;
  Vector6d velocity_ = Vector6d::Zero();  ///< per second: T_cam_map <- exp(velocity dt) T_cam_map, map units
  double step_s_ = 0;                     ///< that it was measured over; 0: there is none
  int map_version_ = 0;
  double residual_k1_ = 0;
  ServoScale scale_;
  std::string failure_;
};

}  // namespace edgevo
