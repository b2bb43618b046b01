// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A sequence of images from one camera, whatever it is stored in. Implementations live in mrpt_bridge
// (rawlogs) and datasets (folders, videos, live cameras).
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/image.h"
#include "edgevo/core/input_decision.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/sensor_reading.h"
#include "edgevo/core/vehicle_track.h"

namespace edgevo {

/// Frames of one camera in time order, with their metadata. One thread at a time.
class ImageSource {
 public:
  virtual ~ImageSource() = default;

  /// Calibration of the images that next() returns.
  virtual const Camera& camera() const = 0;
  /// Mount of the camera on the vehicle (x forward, y left, z up), if the source contains it:
  /// p_vehicle = T p_cam.
  virtual std::optional<SE3> T_vehicle_cam() const { return std::nullopt; }
  /// Number of frames; nullopt if unknown beforehand (live camera, some videos).
  virtual std::optional<int> size() const = 0;
  /// Kind of the source ("KITTI odometry", "rawlog", ...), for `edgevo info` and summary.yaml.
  virtual std::string kind() const = 0;
  /// Whether images arrive in real time and do not wait (live camera).
  virtual bool is_live() const { return false; }
  /// Name of this camera in its source, such as the sensor label of a rawlog; empty if cameras have no names.
  virtual std::string label() const { return {}; }
  /// Positions of the vehicle measured by another sensor; empty if the source has no such recording. May read
  /// the source once more.
  virtual VehicleTrack vehicle_track(VehicleSensor) const { return {}; }
  /// All that its other sensors measured; empty if the source does not give it. May read the source once
  /// more.
  virtual SensorReadings sensor_readings() const { return {}; }
  /// Samples of the gyro next to the camera; empty if the source has none. May read the source once more; the
  /// result is used in the thread of the odometry.
  virtual GyroReadings gyro_readings() const { return {}; }
  /// Further facts for `edgevo info`, as name and value.
  virtual std::vector<std::pair<std::string, std::string>> details() const { return {}; }
  /// What the source took its input to be where that is not stated.
  virtual std::vector<InputDecision> decisions() const { return {}; }
  /// Times of all frames if they are known without decoding the images; else empty.
  virtual std::vector<Timestamp> times() const { return {}; }
  /// Path of the ground truth in the TUM format next to the images; empty if there is none.
  virtual std::string ground_truth_path() const { return {}; }

  /// The next frame in time order; nullopt at the end. Throws BadFrame (bad_frame.h) for an image that does
  /// not decode or differs in size from the camera model, or a time that is missing or does not increase,
  /// after which next() may be called again; another InputError ends the source.
  virtual std::optional<Frame> next() = 0;
  /// Skips the next frame without decoding its image; false at the end.
  virtual bool skip() { return next().has_value(); }
};

}  // namespace edgevo
