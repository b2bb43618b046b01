// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_config.h"

#include <algorithm>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/occupancy/occupancy_params.h"

namespace edgevo {
namespace {

using mrpt::config::CConfigFileBase;

const std::vector<std::string>& own_keys() {
  static const std::vector<std::string> keys{"driver",
                                             "process_rate",
                                             "max_queue_len",
                                             "grab_decimation",
                                             "sensorLabel",
                                             "calibration_file",
                                             "params_file",
                                             "detector",
                                             "metres_per_unit",
                                             "seed",
                                             "realtime",
                                             "external_images",
                                             "at_end",
                                             "max_relative_sigma",
                                             "rawlog-grabber-ignore",
                                             "map"};
  return keys;
}

// Keys of CCameraSensor: complete keys, and prefixes of families of keys.
const std::vector<std::string>& camera_keys() {
  static const std::vector<std::string> keys{"grabber_type",
                                             "preview_decimation",
                                             "preview_reduction",
                                             "capture_grayscale",
                                             "ffmpeg_url",
                                             "rawlog_file",
                                             "rawlog_camera_sensor_label",
                                             "image_dir_url",
                                             "left_format",
                                             "right_format",
                                             "start_index",
                                             "end_index",
                                             "pose_x",
                                             "pose_y",
                                             "pose_z",
                                             "pose_yaw",
                                             "pose_pitch",
                                             "pose_roll"};
  return keys;
}
const std::vector<std::string>& camera_key_families() {
  static const std::vector<std::string> begins{"cv_",     "dc1394_", "bumblebee_", "svs_",  "sr_",
                                               "kinect_", "flycap_", "fcs_",       "myntd_"};
  return begins;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_known(const std::string& key) {
  const auto begins_key = [&](const std::string& begin) { return key.rfind(begin, 0) == 0; };
  return holds(own_keys(), key) || holds(camera_keys(), key) ||
         std::any_of(camera_key_families().begin(), camera_key_families().end(), begins_key);
}

void check_keys(const CConfigFileBase& config, const std::string& section) {
  std::vector<std::string> present, known = own_keys();
  known.insert(known.end(), camera_keys().begin(), camera_keys().end());
  config.getAllKeys(section, present);
  for (const std::string& key : present)
    if (!is_known(key))
      throw InputError("key '" + key + "'", "unknown", "did you mean " + nearest_name(key, known) + "?");
}

// The same file as for `edgevo run`; its group `occupancy` is not used here but must be valid.
void read_params_of_run(const std::string& file, OdometryParams* odometry) {
  OccupancyParams unused;
  read_params_file(file, [&](ParamVisitor& v) {
    odometry->visit(v);
    const auto g = v.group("occupancy");
    unused.visit(v);
  });
}

double number(const CConfigFileBase& config, const std::string& section, const std::string& key, double value,
              double least, double most) {
  value = config.read_double(section, key, value);
  if (value >= least && value <= most) return value;
  std::ostringstream range;
  range << "write a number from " << least << " to " << most;
  throw InputError(key + " = " + config.read_string(section, key, ""), "out of range", range.str());
}

std::string one_of(const CConfigFileBase& config, const std::string& section, const std::string& key,
                   const std::vector<std::string>& choices) {
  const std::string value = config.read_string_first_word(section, key, choices.front());
  if (holds(choices, value)) return value;
  std::string list;
  for (const std::string& choice : choices) list += (list.empty() ? "" : " or ") + choice;
  throw InputError(key + " = " + value, "not known", "write " + key + " = " + list);
}

}  // namespace

SensorConfig read_sensor_config(const CConfigFileBase& config, const std::string& section) {
  check_keys(config, section);
  SensorConfig c;
  c.label = config.read_string(section, "sensorLabel", c.label);
  c.calibration_file = config.read_string(section, "calibration_file", "");
  c.map = config.read_string(section, "map", "");
  c.metres_per_unit = number(config, section, "metres_per_unit", c.metres_per_unit, 0, 1e9);
  if (const std::string file = config.read_string(section, "params_file", ""); !file.empty())
    read_params_of_run(file, &c.odometry);
  if (const std::string detector = config.read_string_first_word(section, "detector", ""); !detector.empty())
    set_param("edges.detector=" + detector, [&](ParamVisitor& v) { c.odometry.visit(v); });
  c.max_relative_sigma = number(config, section, "max_relative_sigma", c.max_relative_sigma, 0.001, 10);
  c.seed = int(number(config, section, "seed", c.seed, 0, 2e9));
  c.realtime = config.read_bool(section, "realtime", c.realtime);
  c.external_images = config.read_bool(section, "external_images", c.external_images);
  c.stop_at_end = one_of(config, section, "at_end", {"stop", "wait"}) == "stop";
  return c;
}

}  // namespace edgevo
