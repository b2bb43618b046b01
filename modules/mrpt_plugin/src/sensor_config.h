#pragma once
// The keys of a [section] that the sensor reads, checked: MRPT's own readers accept a misspelt key silently.
#include <mrpt/config/CConfigFileBase.h>

#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

struct SensorConfig {
  std::string label = "EDGE_VO_CAM";  ///< sensorLabel: of the images
  std::string calibration_file;       ///< empty: as the images say
  double metres_per_unit = 0;         ///< 0: not known, lengths are in an arbitrary unit
  OdometryParams odometry;            ///< params_file and detector
  double max_relative_sigma = 0.15;   ///< of the depth of a point that is recorded
  int seed = 1;
  bool realtime = false;        ///< two threads
  bool external_images = true;  ///< beside the rawlog, lossless; else inside it
  bool stop_at_end = true;      ///< at_end = stop | wait: what to do when no more images come
};

/// Throws InputError: an unknown key (with the nearest one), a value that cannot be. Keys of CCameraSensor
/// are left to it.
SensorConfig read_sensor_config(const mrpt::config::CConfigFileBase& config, const std::string& section);

}  // namespace edgevo
