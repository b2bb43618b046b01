// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The other sensors of a recording of ROS: wheels, satellite navigation, inertial sensors, poses; and where
// they are.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/sensor_reading.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/recordings/static_frames.h"
#include "recording_topics.h"

namespace edgevo {

/// Reads /tf_static.
StaticFrames read_static_frames(Recording* recording);

/// What the readings of a recording refer to.
struct SensorContext {
  /// Path of the recording.
  std::string path;
  /// Where its sensors are.
  StaticFrames frames;
  /// Frame of the vehicle; empty: not known.
  std::string vehicle;
  /// Name of the topic with the images, and their times as stated: the clock that the readings get.
  std::string image_topic;
  std::vector<Timestamp> image_times;
};

/// Whether the recording has messages of sensors.
bool has_sensors(const Recording& recording);

/// All readings: nav_msgs/Odometry, sensor_msgs/NavSatFix with a fix, sensor_msgs/Imu,
/// geometry_msgs/PoseStamped and PoseWithCovarianceStamped. Damaged messages and parts are skipped. Opens
/// the recording once more.
SensorReadings read_sensors(const SensorContext& context);

/// The positions that one kind of sensor measured, of the topic with most of them.
VehicleTrack read_recorded_track(const SensorContext& context, VehicleSensor sensor);

}  // namespace edgevo
