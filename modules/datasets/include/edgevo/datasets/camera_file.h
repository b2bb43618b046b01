// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Calibration files. The formats that are read are distinguished by their content:
//
//   numbers   `fx fy cx cy k1 k2 p1 p2 width height [k3]` on one line; lines that begin with # are comments
//   YAML      of ROS camera_info and of OpenCV's calibration (image_width, image_height, camera_matrix,
//             distortion_coefficients, dist_coeffs, ...; M1 and D1 of a stereo pair), of a camera_info
//             message (width, height, K, D), also as `ros2 topic echo` writes it, of EuRoC and of Kalibr with
//             one camera (resolution, intrinsics, distortion_coefficients or distortion_coeffs)
//   ost.txt   of ROS's camera_calibration, also as .ini
//   DSO       camera.txt with the lens Pinhole or RadTan
//
// open_source() also takes a file without a size (that of the images), such as a 3x3 matrix.
//
// A YAML file may also hold the mount of the camera on its vehicle (core/camera_mount.h), which no other
// program reads: `mount: [roll, pitch, yaw]` in degrees, or with x, y, z in metres.
//
// Lens: plumb-bob (also called radtan, radial-tangential) with 4 or 5 coefficients in the order k1 k2 p1 p2
// k3, or none. Units: pixels; pixel (0,0) is the centre of the top-left pixel. Strict: a wrong number of
// fields, a value that is not finite, a missing or unknown key, a skewed matrix, several cameras, any other
// lens model and the files of other programs give an InputError that names file, line or key.
#include <optional>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/camera_mount.h"

namespace edgevo {

/// Reads a calibration file. Throws InputError.
Camera read_camera_file(const std::string& path);

/// The mount in a calibration file; nullopt if it holds none. Throws InputError.
std::optional<CameraMount> read_camera_mount(const std::string& path);

/// Parses the text of a calibration file; `where` opens the messages. Throws InputError.
Camera parse_camera(const std::string& text, const std::string& where);

/// A calibration as YAML that is readable by ROS (camera_calibration_parsers, camera_info_manager), OpenCV
/// (cv::FileStorage; matrices by `fs["camera_matrix"] >> mat`), MRPT (TCamera::FromYAML) and parse_camera
/// above. Numbers are read back as the same doubles. `comment`: comment lines, may be empty. `mount`: written
/// if given. The residual distortion of a run has to be folded in before (calibration/fold_residual.h).
std::string camera_yaml(const Camera& camera, const std::string& comment,
                        const std::optional<CameraMount>& mount = std::nullopt);

}  // namespace edgevo
