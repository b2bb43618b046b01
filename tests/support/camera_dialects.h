// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Calibration files as other programs write them, made from the documentation of each format: for tests and
// for fuzzing.
#include <sqlite3.h>

#include <cstring>
#include <string>
#include <vector>

namespace edgevo::test {

struct DialectText {
  const char* name;
  /// Camera to choose; empty: the file has one.
  const char* sensor;
  std::string text;
};

/// The bytes of a value, as cameras.bin has them.
template <class Value>
std::string bytes_of(Value value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(&bytes[0], &value, sizeof value);
  return bytes;
}

/// COLMAP's cameras.bin with an OPENCV_FISHEYE (7) and a SIMPLE_RADIAL (9).
inline std::string colmap_binary() {
  std::string bytes = bytes_of<uint64_t>(2) + bytes_of<uint32_t>(7) + bytes_of<int32_t>(5) +
                      bytes_of<uint64_t>(640) + bytes_of<uint64_t>(480);
  for (const double p : {190.0, 191.0, 321.5, 238.5, 0.01, 0.02, -0.03, 0.004}) bytes += bytes_of(p);
  bytes += bytes_of<uint32_t>(9) + bytes_of<int32_t>(2) + bytes_of<uint64_t>(320) + bytes_of<uint64_t>(240);
  for (const double p : {300.0, 160.0, 120.0, -0.1}) bytes += bytes_of(p);
  return bytes;
}

/// Writes COLMAP's database.db with the table of cameras, one camera OPENCV with a prior focal length (1) and
/// one SIMPLE_RADIAL without (2).
inline void write_colmap_database(const std::string& path) {
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  sqlite3_exec(
      database,
      "CREATE TABLE cameras (camera_id INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, model INTEGER NOT "
      "NULL, width INTEGER NOT NULL, height INTEGER NOT NULL, params BLOB, prior_focal_length INTEGER "
      "NOT NULL)",
      nullptr, nullptr, nullptr);
  const auto insert = [&](int id, int model, const std::vector<double>& params, int prior) {
    sqlite3_stmt* row = nullptr;
    sqlite3_prepare_v2(database, "INSERT INTO cameras VALUES (?, ?, 640, 480, ?, ?)", -1, &row, nullptr);
    sqlite3_bind_int(row, 1, id);
    sqlite3_bind_int(row, 2, model);
    sqlite3_bind_blob(row, 3, params.data(), int(params.size() * sizeof(double)), SQLITE_TRANSIENT);
    sqlite3_bind_int(row, 4, prior);
    sqlite3_step(row);
    sqlite3_finalize(row);
  };
  insert(1, 4, {500, 501, 320.5, 240.5, 0.1, -0.02, 0.001, 0.002}, 1);
  insert(2, 2, {768, 320, 240, 0}, 0);
  sqlite3_close(database);
}

inline std::vector<DialectText> camera_dialects() {
  const std::string kalibr = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [0.1, -0.02, 0.001, 0.002]
  distortion_model: radtan
  intrinsics: [500.0, 501.0, 320.0, 240.0]
  resolution: [640, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.1]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [0]
  camera_model: omni
  distortion_coeffs: [-0.1, 0.2, 0.001, -0.0005]
  distortion_model: radtan
  intrinsics: [1.5, 250.0, 251.0, 321.0, 238.0]
  resolution: [640, 480]
  timeshift_cam_imu: 0.002
cam2:
  camera_model: ds
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [0.25, 0.6, 250.0, 251.0, 321.0, 238.0]
  resolution: [640, 480]
cam3:
  camera_model: eucm
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [0.6, 1.1, 250.0, 251.0, 321.0, 238.0]
  resolution: [640, 480]
cam4:
  camera_model: pinhole
  distortion_coeffs: [0.01, 0.02, -0.03, 0.004]
  distortion_model: equidistant
  intrinsics: [190.0, 191.0, 321.0, 238.0]
  resolution: [640, 480]
cam5:
  camera_model: pinhole
  distortion_coeffs: [1.5707963267948966]
  distortion_model: fov
  intrinsics: [250.0, 251.0, 321.0, 238.0]
  resolution: [640, 480]
cam6:
  camera_model: omni
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [1.5, 250.0, 251.0, 321.0, 238.0]
  resolution: [640, 480]
cam7:
  camera_model: pinhole
  distortion_coeffs: []
  distortion_model: none
  intrinsics: [500.0, 501.0, 320.0, 240.0]
  resolution: [640, 480]
)";
  const std::string orb_fisheye = R"(%YAML:1.0
# Camera Parameters. Adjust them!
File.version: "1.0"
Camera.type: "KannalaBrandt8"
Camera1.fx: 190.0
Camera1.fy: 191.0
Camera1.cx: 321.0
Camera1.cy: 238.0
Camera1.k1: 0.01
Camera1.k2: 0.02
Camera1.k3: -0.03
Camera1.k4: 0.004
Camera.width: 640
Camera.height: 480
Camera.newWidth: 320
Camera.newHeight: 240
Camera.fps: 20
Camera.RGB: 1
Tlr: !!opencv-matrix
  rows: 3
  cols: 4
  dt: f
  data: [1.0, 0.0, 0.0, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
IMU.NoiseGyro: 0.00016
ORBextractor.nFeatures: 1250
Viewer.KeyFrameSize: 0.05
)";
  const std::string orb2 = R"(%YAML:1.0
Camera.fx: 500.0
Camera.fy: 501.0
Camera.cx: 320.0
Camera.cy: 240.0
Camera.k1: 0.1
Camera.k2: -0.02
Camera.p1: 0.001
Camera.p2: 0.002
Camera.k3: 0.3
Camera.width: 640
Camera.height: 480
Camera.fps: 30.0
Camera.bf: 40.0
ThDepth: 40.0
ORBextractor.scaleFactor: 1.2
)";
  const std::string orb2_stereo = R"(%YAML:1.0
Camera.fx: 435.2
Camera.fy: 435.2
Camera.cx: 367.4
Camera.cy: 252.2
Camera.width: 752
Camera.height: 480
LEFT.height: 480
LEFT.width: 752
LEFT.D: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data:[-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0]
LEFT.K: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [458.654, 0.0, 367.215, 0.0, 457.296, 248.375, 0.0, 0.0, 1.0]
RIGHT.K: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [457.587, 0.0, 379.999, 0.0, 456.134, 255.238, 0.0, 0.0, 1]
)";
  const std::string stella = R"(Camera:
  name: "EuRoC monocular"
  setup: "monocular"
  model: "fisheye"
  fx: 190.0
  fy: 191.0
  cx: 321.0
  cy: 238.0
  k1: 0.01
  k2: 0.02
  k3: -0.03
  k4: 0.004
  fps: 20.0
  cols: 640
  rows: 480
  color_order: "Gray"
Preprocessing:
  min_size: 800
)";
  const std::string basalt =
      R"({"value0": {"T_imu_cam": [{"px": 0.1, "py": 0, "pz": 0, "qx": 0, "qy": 0, "qz": 0, "qw": 1}],
  "intrinsics": [
    {"camera_type": "ds", "intrinsics": {"fx": 250.0, "fy": 251.0, "cx": 321.0, "cy": 238.0, "xi": 0.25, "alpha": 0.6}},
    {"camera_type": "kb4", "intrinsics": {"fx": 190.0, "fy": 191.0, "cx": 321.0, "cy": 238.0, "k1": 0.01, "k2": 0.02, "k3": -0.03, "k4": 0.004}},
    {"camera_type": "eucm", "intrinsics": {"fx": 250.0, "fy": 251.0, "cx": 321.0, "cy": 238.0, "alpha": 0.6, "beta": 1.1}},
    {"camera_type": "ucm", "intrinsics": {"fx": 250.0, "fy": 251.0, "cx": 321.0, "cy": 238.0, "alpha": 0.6}},
    {"camera_type": "fov", "intrinsics": {"fx": 250.0, "fy": 251.0, "cx": 321.0, "cy": 238.0, "w": 1.5707963267948966}},
    {"camera_type": "pinhole", "intrinsics": {"fx": 500, "fy": 501, "cx": 320, "cy": 240}},
    {"camera_type": "pinhole-radtan8", "intrinsics": {"fx": 250.0, "fy": 251.0, "cx": 321.0, "cy": 238.0, "k1": 3.1, "k2": 1.4, "p1": 2e-4, "p2": -1e-4, "k3": 0.05, "k4": 3.4, "k5": 2.2, "k6": 0.26, "rpmax": 2.7}}
  ],
  "resolution": [[640, 480], [640, 480], [640, 480], [640, 480], [640, 480], [640, 480], [640, 480]],
  "vignette": [], "cam_time_offset_ns": 0}}
)";
  const std::string colmap = R"(# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
# Number of cameras: 9
1 SIMPLE_PINHOLE 640 480 500 320.5 240.5
2 PINHOLE 640 480 500 501 320.5 240.5
3 SIMPLE_RADIAL 640 480 500 320.5 240.5 0.1
4 RADIAL 640 480 500 320.5 240.5 0.1 -0.02
5 OPENCV 640 480 500 501 320.5 240.5 0.1 -0.02 0.001 0.002
6 OPENCV_FISHEYE 640 480 190 191 321.5 238.5 0.01 0.02 -0.03 0.004
7 FULL_OPENCV 640 480 250 251 321.5 238.5 3.1 1.4 2e-4 -1e-4 0.05 3.4 2.2 0.26
8 FOV 640 480 250 251 321.5 238.5 1.5707963267948966
9 SIMPLE_RADIAL_FISHEYE 640 480 190 321.5 238.5 0.01
10 RADIAL_FISHEYE 640 480 190 321.5 238.5 0.01 0.02
11 THIN_PRISM_FISHEYE 640 480 190 191 321.5 238.5 0.01 0.02 0 0 -0.03 0.004 0 0
)";
  const std::string mrpt = R"(# Calibration
[CAMERA_PARAMS]
resolution = [640 480]
cx         = 320.000
cy         = 240.000
fx         = 500.000
fy         = 501.000
dist       = [1.000000e-01 -2.000000e-02 1.000000e-03 2.000000e-03 3.000000e-01]
camera_name = camera1
focal_length = 0.0       // meters
)";
  const std::string mrpt_stereo = R"([CAMERA_PARAMS_LEFT]
resolution = [640 480]
cx = 320
cy = 240
fx = 500
fy = 501
dist = [0.1 -0.02 0.001 0.002 0.3 0 0 0]
distortion = plumb_bob
[CAMERA_PARAMS_RIGHT]
resolution = [640 480]
cx = 321
cy = 238
fx = 190
fy = 191
dist = [0.01 0.02 0 0 -0.03 0.004]
distortion = kannala_brandt
[CAMERA_PARAMS_LEFT2RIGHT_POSE]
pose_quaternion = [0.12 0 0 1 0 0 0]
)";
  const std::string visp = R"(<?xml version="1.0"?>
<root>
  <!--This file stores intrinsic camera parameters used in the vpCameraParameters Class of ViSP-->
  <camera>
    <!--Name of the camera-->
    <name>Camera</name>
    <image_width>640</image_width>
    <image_height>480</image_height>
    <model>
      <type>perspectiveProjWithoutDistortion</type>
      <px>495</px><py>496</py><u0>318</u0><v0>239</v0>
    </model>
    <model>
      <type>perspectiveProjWithDistortion</type>
      <px>500</px>
      <py>501</py>
      <u0>320</u0>
      <v0>240</v0>
      <kud>0.1</kud>
      <kdu>-0.098</kdu>
    </model>
    <additional_information>
      <date>2024/01/01</date>
    </additional_information>
  </camera>
</root>
)";
  const std::string visp_tracker = R"(<?xml version="1.0"?>
<conf>
  <face><near_clipping>0.1</near_clipping></face>
  <camera>
    <width>640</width><height>480</height>
    <u0>320</u0><v0>240</v0><px>500</px><py>501</py>
  </camera>
</conf>
)";
  const std::string opencv_xml = R"(<?xml version="1.0"?>
<opencv_storage>
<calibration_time>"Mon Jan  1 10:00:00 2024"</calibration_time>
<nframes>25</nframes>
<image_width>640</image_width>
<image_height>480</image_height>
<board_width>9</board_width>
<fisheye_model>1</fisheye_model>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    1.90e+02 0. 321. 0. 191. 238. 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix">
  <rows>4</rows>
  <cols>1</cols>
  <dt>d</dt>
  <data>
    0.01 0.02 -0.03
    0.004</data></distortion_coefficients>
<avg_reprojection_error>3.5e-01</avg_reprojection_error>
</opencv_storage>
)";
  const auto vins = [](const std::string& model, const std::string& parameters) {
    return "%YAML:1.0\n---\nmodel_type: " + model +
           "\ncamera_name: camera\nimage_width: 640\nimage_height: 480\n" + parameters;
  };
  return {
      {"KalibrPinholeRadtan", "cam0", kalibr},
      {"KalibrOmniRadtan", "cam1", kalibr},
      {"KalibrDoubleSphere", "cam2", kalibr},
      {"KalibrEucm", "cam3", kalibr},
      {"KalibrPinholeEquidistant", "cam4", kalibr},
      {"KalibrPinholeFov", "cam5", kalibr},
      {"KalibrOmniNone", "cam6", kalibr},
      {"KalibrPinholeNone", "cam7", kalibr},
      {"OrbSlam3Fisheye", "", orb_fisheye},
      {"OrbSlam2", "", orb2},
      {"OrbSlam2RawLeft", "LEFT", orb2_stereo},
      {"StellaFisheye", "", stella},
      {"BasaltDoubleSphere", "cam0", basalt},
      {"BasaltKannalaBrandt", "cam1", basalt},
      {"BasaltEucm", "cam2", basalt},
      {"BasaltUcm", "cam3", basalt},
      {"BasaltFov", "cam4", basalt},
      {"BasaltPinhole", "cam5", basalt},
      {"BasaltRadtan8", "cam6", basalt},
      {"ColmapSimplePinhole", "1", colmap},
      {"ColmapPinhole", "2", colmap},
      {"ColmapSimpleRadial", "3", colmap},
      {"ColmapRadial", "4", colmap},
      {"ColmapOpencv", "5", colmap},
      {"ColmapOpencvFisheye", "6", colmap},
      {"ColmapFullOpencv", "7", colmap},
      {"ColmapFov", "8", colmap},
      {"ColmapSimpleRadialFisheye", "9", colmap},
      {"ColmapRadialFisheye", "10", colmap},
      {"ColmapThinPrismOfZero", "11", colmap},
      {"ColmapBinaryFisheye", "7", colmap_binary()},
      {"DsoFovRelative", "", "0.390625 0.5229166667 0.50234375 0.496875 0.93\n640 480\ncrop\n640 480\n"},
      {"DsoFovInPixels", "", "FOV 250 251 321 238 1.5707963267948966\n640 480\nfull\n320 240\n"},
      {"DsoEquiDistant", "",
       "EquiDistant 190 191 321 238 0.01 0.02 -0.03 0.004\n640 480\n0.4 0.53 0.5 0.5 0\n640 480\n"},
      {"DsoPinhole", "", "Pinhole 500 501 320 240 0\n640 480\nnone\n640 480\n"},
      {"MrptIni", "", mrpt},
      {"MrptIniFisheyeRight", "CAMERA_PARAMS_RIGHT", mrpt_stereo},
      {"VispXml", "", visp},
      {"VispTrackerXml", "", visp_tracker},
      {"OpencvXmlFisheye", "", opencv_xml},
      {"VinsPinhole", "",
       vins("PINHOLE",
            "distortion_parameters:\n   k1: 0.1\n   k2: -0.02\n   p1: 0.001\n   p2: 0.002\n"
            "projection_parameters:\n   fx: 500.0\n   fy: 501.0\n   cx: 320.0\n   cy: 240.0\n")},
      {"VinsMei", "",
       vins("MEI",
            "mirror_parameters:\n   xi: 1.5\ndistortion_parameters:\n   k1: -0.1\n   k2: 0.2\n   p1: 0.001\n "
            "  "
            "p2: -0.0005\nprojection_parameters:\n   gamma1: 250.0\n   gamma2: 251.0\n   u0: 321.0\n   v0: "
            "238.0\n")},
      {"VinsKannalaBrandt", "",
       vins(
           "KANNALA_BRANDT",
           "projection_parameters:\n   k2: 0.01\n   k3: 0.02\n   k4: -0.03\n   k5: 0.004\n   mu: 190\n   mv: "
           "191\n   u0: 321\n   v0: 238\n")},
  };
}

}  // namespace edgevo::test
