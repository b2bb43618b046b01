// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Calibration files. The formats that are read are distinguished by their content:
//
//   numbers   `fx fy cx cy k1 k2 p1 p2 width height [k3]` on one line; lines that begin with # are comments
//   YAML      of ROS camera_info and of OpenCV's calibration (image_width, image_height, camera_matrix,
//             distortion_coefficients, dist_coeffs, ...; M1 and D1 of a stereo pair), of a camera_info
//             message (width, height, K, D), also as `ros2 topic echo` writes it, of EuRoC and of Kalibr
//             (resolution, intrinsics, distortion_coefficients or distortion_coeffs)
//   settings  of ORB-SLAM2 and 3 and stella_vslam; cameras of CamOdoCal (VINS, KITTI-360)
//   ost.txt   of ROS's camera_calibration, also as .ini
//   DSO       camera.txt, also of the TUM monoVO data set
//   COLMAP    cameras.txt, cameras.bin, database.db; the folder of a reconstruction, or the one around it
//   Basalt    calibration.json
//   MRPT      .ini with [CAMERA_PARAMS...]
//   XML       of ViSP, also of its trackers, and of OpenCV
//   JSON      of ViSP, which has no size
//
// Of a file with several cameras one is chosen by its name: cam1 (Kalibr, Basalt), a number (COLMAP),
// Camera1, LEFT (ORB-SLAM), the name of the section or element (MRPT, ViSP). open_source() also takes a file
// without a size (that of the images), such as a 3x3 matrix.
//
// A YAML file may also hold the mount of the camera on its vehicle (core/camera_mount.h), which no other
// program reads: `mount: [roll, pitch, yaw]` in degrees, or with x, y, z in metres.
//
// So may it hold how a gyro sits next to the camera, as a run has found it: `gyro: [x, y, z, offset]`, the
// vector of the rotation from the axes of the gyro to those of the camera in degrees, and by how many seconds
// its clock is ahead.
//
// Lens: by `distortion_model` (and Kalibr's `camera_model`), with the coefficients in this order and the
// focal lengths as the model's own formula has them (core/camera_models.h says how they relate to those on
// the axis):
//
//   plumb_bob (radtan)                    k1 k2 p1 p2 k3, the last may be missing
//   rational_polynomial (rational)        k1 k2 p1 p2 k3 k4 k5 k6, then s1 s2 s3 s4 if there is a thin prism
//   equidistant (kannala_brandt, kb4)     k1 k2 k3 k4; also OpenCV's `fisheye_model: 1`
//   fov (atan)                            omega, radians
//   ucm, eucm                             alpha; alpha beta
//   double_sphere (ds)                    xi alpha
//   omni (mei)                            xi k1 k2 p1 p2; also OpenCV's `xi` with k1 k2 p1 p2
//
// Without a name the number of coefficients says whether they are plumb-bob or rational. Units: pixels; pixel
// (0,0) is the centre of the top-left pixel. Strict: a wrong number of fields, a value that is not finite, a
// missing or unknown key, a skewed matrix, any other lens model and the files of other programs give an
// InputError that names file, line or key.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/camera_mount.h"
#include "edgevo/gyro/gyro_model.h"

namespace edgevo {

/// Reads a calibration file; `sensor` names one of its cameras, if it has several. Throws InputError.
Camera read_camera_file(const std::string& path, const std::string& sensor = "");

/// The mount in a calibration file; nullopt if it holds none. Throws InputError.
std::optional<CameraMount> read_camera_mount(const std::string& path);

/// The gyro in a calibration file, as exact as a run finds one; its bias is not known. nullopt if it holds
/// none. Throws InputError.
std::optional<GyroModel> read_camera_gyro(const std::string& path);

/// Parses the text of a calibration file; `where` opens the messages. Throws InputError.
Camera parse_camera(const std::string& text, const std::string& where, const std::string& sensor = "");

/// A calibration as YAML that is readable by ROS (camera_calibration_parsers, camera_info_manager), OpenCV
/// (cv::FileStorage; matrices by `fs["camera_matrix"] >> mat`), MRPT (TCamera::FromYAML, plumb-bob only) and
/// parse_camera above, which reads every lens. Numbers are read back as the same doubles, focal lengths of
/// fov, double_sphere and omni to the last digit. `comment`: comment lines, may be empty. `mount`: written
/// if given. The residual distortion of a run has to be folded in before (calibration/fold_residual.h).
std::string camera_yaml(const Camera& camera, const std::string& comment,
                        const std::optional<CameraMount>& mount = std::nullopt);

/// The line of a gyro, to be added to such a file.
std::string gyro_yaml(const GyroModel& gyro);

/// The formats of camera_file_text(): "ros", "kalibr", "orb_slam", "opencv".
std::vector<std::string> camera_file_formats();

/// A calibration as another program reads it, with `comment` in comment lines; parse_camera() gives the same
/// rays. ROS's camera_info in YAML, Kalibr's camchain with one camera, the camera's part of ORB-SLAM's
/// settings, OpenCV's file of its calibration samples. Throws InputError for a format that is not known and
/// for a lens, or a coefficient, that the program does not have.
std::string camera_file_text(const Camera& camera, const std::string& format, const std::string& comment);

}  // namespace edgevo
