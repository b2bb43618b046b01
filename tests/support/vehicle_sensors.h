// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Wheels and GPS of a vehicle whose path is known, with noise, and with the mistakes that such sensors make.
#include <cmath>
#include <random>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/vehicle_track.h"

namespace edgevo::test {

/// True poses of the camera, metres, and their times.
struct TimedPath {
  std::vector<Timestamp> times;
  std::vector<SE3> poses;
};

struct SensorNoise {
  /// Standard deviation of each step of the wheels, relative, and of each GPS fix along each axis, metres.
  double step = 0.02, fix = 0.5;
  unsigned seed = 3;
};

/// Between two shares of the path's frames the wheels count `factor` times the way.
struct WheelSlip {
  double begin = 0, end = 0, factor = 1;
};

/// From a share of the path's frames on, for some seconds, the fixes are displaced, metres.
struct GpsJump {
  double begin = 0, seconds = 0, metres = 0;
};

inline SE3 sensor_axes() {  // the sensor's frame is turned against the camera's
  return {Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized())), {100, -50, 3}};
}

inline VehicleTrack wheels_of(const TimedPath& path, const SensorNoise& noise, const WheelSlip& slip = {}) {
  std::mt19937 random(noise.seed);
  std::normal_distribution<double> normal;
  VehicleTrack track;
  Eigen::Vector3d position = sensor_axes() * path.poses.front().translation(), last = position;
  for (size_t i = 0; i < path.poses.size(); ++i) {
    const Eigen::Vector3d here = sensor_axes() * path.poses[i].translation();
    const double share = double(i) / double(path.poses.size());
    const double counted = share >= slip.begin && share < slip.end ? slip.factor : 1;
    position += counted * (1 + noise.step * normal(random)) * (here - last);
    last = here;
    track.positions.push_back({path.times[i], position});
  }
  return track;
}

inline VehicleTrack gps_of(const TimedPath& path, const SensorNoise& noise, const GpsJump& jump = {}) {
  std::mt19937 random(noise.seed + 1000);
  std::normal_distribution<double> normal;
  VehicleTrack track;
  const Timestamp from = path.times[size_t(jump.begin * double(path.poses.size()))];
  const Eigen::Vector3d displacement = jump.metres * Eigen::Vector3d(0.6, 0, 0.8);  // of the camera's axes
  for (size_t i = 0; i < path.poses.size(); ++i) {
    const double since = seconds_between(from, path.times[i]);
    Eigen::Vector3d here = path.poses[i].translation();
    if (since >= 0 && since < jump.seconds) here += displacement;
    const Eigen::Vector3d jitter(normal(random), normal(random), normal(random));
    track.positions.push_back({path.times[i], sensor_axes() * here + noise.fix * jitter});
  }
  return track;
}

/// The same positions with other times.
inline VehicleTrack delayed(VehicleTrack track, double seconds) {
  for (VehiclePosition& p : track.positions)
    p.time.ticks += int64_t(std::llround(seconds * double(Timestamp::kTicksPerSecond)));
  return track;
}

/// A GPS whose fixes drift away at this speed along one axis.
inline VehicleTrack drifting(VehicleTrack track, double metres_per_second) {
  const Timestamp from = track.positions.front().time;
  for (VehiclePosition& p : track.positions)
    p.position.x() += metres_per_second * seconds_between(from, p.time);
  return track;
}

/// Without the positions between two shares of the track.
inline VehicleTrack without(const VehicleTrack& track, double begin, double end) {
  VehicleTrack rest = track;
  rest.positions.clear();
  for (size_t i = 0; i < track.positions.size(); ++i) {
    const double share = double(i) / double(track.positions.size());
    if (share < begin || share >= end) rest.positions.push_back(track.positions[i]);
  }
  return rest;
}

}  // namespace edgevo::test
