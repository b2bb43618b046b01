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
  static const Keys keys = joined(camera_matrix_keys(), distortion_keys(),
                                  {"intrinsics", "resolution", "image_width", "image_height", "width",
                                   "height", "distortion_model", "camera_model", "mount"});
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
  const std::string cut = "the images show a part of the sensor",
                    cut_remedy = "give the calibration of these images, with width and height of their own";
  static const std::vector<CameraKeyWithDefault> keys{
      {"fisheye_model", {"0", "false"}, "the fisheye lens is not supported", kUndistortImages},
      {"xi", {}, "the omnidirectional lens is not supported", kUndistortImages},
      {"binning_x", {"0", "1"}, "the images are smaller than the sensor", cut_remedy},
      {"binning_y", {"0", "1"}, "the images are smaller than the sensor", cut_remedy},
      {"roi.x_offset", {"0"}, cut, cut_remedy},
      {"roi.y_offset", {"0"}, cut, cut_remedy},
      {"roi.width", {"0"}, cut, cut_remedy},
      {"roi.height", {"0"}, cut, cut_remedy},
      {"roi.do_rectify", {"false", "False", "0"}, "the images are rectified", cut_remedy},
  };
  return keys;
}

void refuse_other_settings(const YamlValues& values, const std::string& where) {
  if (has_key(values, "camera.fx") || has_key(values, "camera1.fx"))
    refuse_form(where, "a settings file of ORB-SLAM, stella_vslam or the like");
  if (has_key(values, "camera.model") || has_key(values, "camera.setup"))
    refuse_form(where, "a settings file of stella_vslam");
  if (const auto it = values.find("model_type"); it != values.end()) {
    const std::string lens = it->second.texts.empty() ? "" : it->second.texts.front();
    if (lens == "PINHOLE") refuse_form(where, "a camera of CamOdoCal (VINS-Mono), lens PINHOLE");
    throw InputError(where,
                     "is a camera of CamOdoCal (VINS-Mono, KITTI-360) with the lens " + quote(lens) +
                         ", which is not supported",
                     kUndistortImages);
  }
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
