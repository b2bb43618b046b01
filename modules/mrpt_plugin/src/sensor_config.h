// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The keys of a [section] that the sensor reads, checked: MRPT's own readers accept a misspelt key silently.
#include <mrpt/config/CConfigFileBase.h>

#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

struct SensorConfig {
  /// sensorLabel: label of the images.
  std::string label = "EDGE_VO_CAM";
  /// Calibration file; empty: the calibration of the images.
  std::string calibration_file;
  /// Metres per unit; 0: unknown, lengths are in an arbitrary unit.
  double metres_per_unit = 0;
  /// map.db or folder of an earlier run whose frame and unit the recording gets; empty: none.
  std::string map;
  /// Parameters, from params_file and detector.
  OdometryParams odometry;
  /// Largest relative standard deviation of the depth of a recorded point.
  double max_relative_sigma = 0.15;
  int seed = 1;
  /// True: two threads.
  bool realtime = false;
  /// True: images are lossless files next to the rawlog; false: inside it.
  bool external_images = true;
  /// Key at_end = stop | wait: true ends rawlog-grabber at the end of the images.
  bool stop_at_end = true;
};

/// Reads and checks the section. Throws InputError for an unknown key (with the nearest one) and for an
/// invalid value. Keys of CCameraSensor are not checked.
SensorConfig read_sensor_config(const mrpt::config::CConfigFileBase& config, const std::string& section);

}  // namespace edgevo
