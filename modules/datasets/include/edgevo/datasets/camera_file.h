// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Calibration files. Two formats are read, distinguished by their content:
//
//   numbers   `fx fy cx cy k1 k2 p1 p2 width height [k3]` on one line; lines that begin with # are comments
//   YAML      of ROS camera_info and of OpenCV's calibration (image_width, image_height, camera_matrix,
//             distortion_coefficients), of a camera_info message (width, height, K, D), of EuRoC and of
//             Kalibr with one camera (resolution, intrinsics, distortion_coefficients or distortion_coeffs)
//
// Lens: plumb-bob (also called radtan, radial-tangential) with 4 or 5 coefficients in the order k1 k2 p1 p2
// k3, or none. Units: pixels; pixel (0,0) is the centre of the top-left pixel. Strict: a wrong number of
// fields, a value that is not finite, a missing key, a skewed matrix, several cameras and any other lens
// model give an InputError that names file, line or key.
#include <string>

#include "edgevo/core/camera.h"

namespace edgevo {

/// Reads a calibration file. Throws InputError.
Camera read_camera_file(const std::string& path);

/// Parses the text of a calibration file; `where` opens the messages. Throws InputError.
Camera parse_camera(const std::string& text, const std::string& where);

/// A calibration as YAML that is readable by ROS (camera_calibration_parsers, camera_info_manager), OpenCV
/// (cv::FileStorage; matrices by `fs["camera_matrix"] >> mat`), MRPT (TCamera::FromYAML) and parse_camera
/// above. Numbers are read back as the same doubles. `comment`: comment lines, may be empty. The residual
/// distortion of a run has to be folded in before (calibration/fold_residual.h).
std::string camera_yaml(const Camera& camera, const std::string& comment);

}  // namespace edgevo
