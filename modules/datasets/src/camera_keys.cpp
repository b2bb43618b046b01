// SPDX-License-Identifier: BSD-3-Clause
#include "camera_keys.h"

#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Keys = std::vector<std::string>;

Keys joined(const Keys& a, const Keys& b, const Keys& c) {
  Keys all = a;
  all.insert(all.end(), b.begin(), b.end());
  all.insert(all.end(), c.begin(), c.end());
  return all;
}

bool has_key(const YamlValues& values, const std::string& key) { return values.count(key) > 0; }

bool has_group(const YamlValues& values, const std::string& group) {
  const auto it = values.lower_bound(group + ".");
  return it != values.end() && it->first.rfind(group + ".", 0) == 0;
}

}  // namespace

void fail_count(const std::string& where, const std::string& key, size_t found, const std::string& expected) {
  throw InputError(where, key + " holds " + std::to_string(found) + " numbers", "write " + expected);
}

std::string only_key(const YamlValues& values, const Keys& keys, const std::string& where) {
  std::string found;
  for (const std::string& name : keys)
    for (const std::string& key : {name, name + ".data"}) {
      if (!values.count(key)) continue;
      if (!found.empty())
        throw InputError(where, quote(found) + " and " + quote(key) + " mean the same", "keep one");
      found = key;
    }
  return found;
}

std::vector<double> numbers_of(const YamlValues& values, const Keys& keys, const std::string& where) {
  const std::string key = only_key(values, keys, where);
  if (key.empty()) return {};
  const YamlValue& value = values.at(key);
  if (!value.is_given)
    throw InputError(where + ", line " + std::to_string(value.line), quote(key) + " has no value",
                     "write its numbers, or leave the key out");
  return yaml_numbers(values, {key}, where);
}

// "k", "d": camera_info. "m1", "d1": OpenCV's stereo sample. The others: names in use for OpenCV's files.
const Keys& camera_matrix_keys() {
  static const Keys keys{"camera_matrix", "k", "m1", "cameramatrix", "intrinsic_matrix", "mtx"};
  return keys;
}

const Keys& distortion_keys() {
  static const Keys keys{"distortion_coefficients",
                         "distortion_coeffs",
                         "distcoeffs",
                         "distcoeff",
                         "dist_coeffs",
                         "dist_coeff",
                         "distortion",
                         "dist",
                         "d",
                         "d1"};
  return keys;
}

const Keys& used_camera_keys() {
  static const Keys keys =
      joined(camera_matrix_keys(), distortion_keys(),
             {"intrinsics", "resolution", "image_width", "image_height", "width", "height",
              "distortion_model", "camera_model", "fisheye_model", "xi", "binning_x", "binning_y",
              "roi.x_offset", "roi.y_offset", "roi.width", "roi.height", "mount", "gyro"});
  return keys;
}

const Keys& ignored_camera_keys() {
  static const Keys keys{
      // ROS: names and stamps; rectified images are not the ones that are read. (A rotation is noted.)
      "camera_name", "header", "rectification_matrix", "projection_matrix", "r", "p",
      // OpenCV and its relatives: how the calibration was made, and how well it fits.
      "calibration_time", "calibration_date", "date", "nr_of_frames", "nrofframes", "nframes", "n_frames",
      "board_width", "board_height", "square_size", "marker_size", "pattern", "pattern_size",
      "fix_aspect_ratio", "fixaspectratio", "aspectratio", "flags", "flagvalue", "flag_value",
      "avg_reprojection_error", "reprojection_error", "rms", "rms_error", "error",
      "per_view_reprojection_errors", "extrinsic_parameters", "image_points", "grid_points", "m2", "d2",
      // EuRoC, Kalibr, OpenVINS: the rig, the IMU, topics and clocks.
      "sensor_type", "comment", "rate_hz", "cam_overlaps", "rostopic", "t_bs", "t_cam_imu", "t_imu_cam",
      "t_cn_cnm1", "t_cam_body", "t_body_cam", "timeshift_cam_imu", "timeshift_imu_cam",
      "accelerometer_noise_density", "accelerometer_random_walk", "gyroscope_noise_density",
      "gyroscope_random_walk", "integration_sigma", "update_rate",
      // MRPT: the size of the chip.
      "focal_length_meters", "focallengthmeters"};
  return keys;
}

// Where the second camera is, and what rectifies the pair.
const Keys& ignored_stereo_keys() {
  static const Keys keys{"r1", "r2", "p1", "p2", "q", "t", "e", "f", "roi1", "roi2", "alpha1", "alpha2"};
  return keys;
}

const std::vector<CameraKeyWithDefault>& camera_keys_with_default() {
  static const std::vector<CameraKeyWithDefault> keys{
      {"roi.do_rectify",
       {"false", "False", "0"},
       "the images are rectified",
       "give the camera of the projection_matrix, without distortion"},
  };
  return keys;
}

std::string remedy_for_key(const std::string& key) {
  static const std::set<std::string> matrix{"fx", "fy", "cx", "cy", "f", "focal_length", "principal_point"},
      lens{"k1", "k2", "k3", "k4", "p1", "p2"}, mount{"roll", "pitch", "yaw"};
  if (matrix.count(key)) return "write camera_matrix: [fx, 0, cx, 0, fy, cy, 0, 0, 1]";
  if (lens.count(key)) return "write distortion_coefficients: [k1, k2, p1, p2, k3] and distortion_model";
  if (mount.count(key) || key.rfind("mount.", 0) == 0)
    return "write mount: [roll, pitch, yaw] in degrees, or with x, y, z in metres behind them";
  return {};
}

void refuse_other_settings(const YamlValues& values, const std::string& where) {
  for (const char* key : {"p0", "p1", "p2", "p3", "p_rect_00", "p_rect_02"})
    if (const auto it = values.find(key); it != values.end() && it->second.texts.size() == 1 &&
                                          it->second.texts.front().find(' ') != std::string::npos)
      throw InputError(where, "is KITTI's calib.txt, which holds several cameras",
                       "give the sequence's folder as the source, or write `fx fy cx cy 0 0 0 0 width "
                       "height` of one of them on one line");
  if (has_key(values, "camera_matrix") || has_group(values, "camera_matrix")) return;
  for (const auto& [key, value] : values)
    for (const Keys& known : {used_camera_keys(), ignored_camera_keys(), ignored_stereo_keys()})
      for (const std::string& name : known)
        if (key == name || key.rfind(name + ".", 0) == 0) return;
  throw InputError(where, "is not a camera file of a known form: it has neither camera_matrix nor intrinsics",
                   kWriteNumbers);
}

}  // namespace edgevo
