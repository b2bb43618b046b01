// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What `edgevo calibrate` says about a camera: lines of text, each ended, and the remark in the camera file.
#include <string>

#include "edgevo/calibration/calibrate_camera.h"
#include "edgevo/calibration/camera_from_motion.h"
#include "edgevo/calibration/run_calibration.h"

namespace edgevo {

/// What self-calibration found, in a line: "residual k1 0.0102 +- 0.0008 (one standard deviation), from 40
/// keyframes".
std::string finding(const CameraPosterior& refinement);
/// The finding, the lens before and after, and what was seen but is not in the new camera.
std::string run_calibration_text(const RunCalibration& run, const FoldedCamera& corrected);

/// Views used and skipped, focal length, lens and residuals, what further views would add.
std::string board_calibration_text(const CameraCalibration& calibration, const BoardViews& views);
/// Remark for the camera file.
std::string board_calibration_origin(const CameraCalibration& calibration);

/// Focal length, principal point and distortion with their standard deviations, in a line.
std::string motion_calibration_text(const MotionCalibration& calibration);
/// Remark for the camera file.
std::string motion_calibration_origin(const MotionCalibration& calibration);

/// Which programs read a camera file of this format (camera_file_text()).
std::string camera_file_use(const std::string& path, const std::string& format, const Camera& camera);

}  // namespace edgevo
