// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Pinhole and plumb-bob lens from views of a board (Zhang, "A Flexible New Technique for Camera Calibration",
// as implemented in OpenCV), with the means to assess them: residuals, standard deviations, and what the
// views lack.
//
// Views whose residuals exceed three times those of the median view are rejected once (a blurred image, a
// wrong corner). The coefficient k3 is used only where it differs from 0 by three of its standard deviations:
// with few views it fits noise and distorts the corners of the image.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "edgevo/calibration/board_views.h"
#include "edgevo/core/camera.h"

namespace edgevo {

/// Residuals of one view.
struct ViewFit {
  /// Index of the image in its source.
  int frame = 0;
  /// RMS of the view's residuals, pixels.
  double rms_px = 0;
  /// Detected corners, distorted pixels.
  std::vector<Eigen::Vector2f> px;
  /// Detected minus projected corner, pixels.
  std::vector<Eigen::Vector2f> residual_px;
  /// Normal of the board in the camera frame, unit length, z > 0.
  Eigen::Vector3d normal_cam;
};

/// A calibrated camera with the means to assess it.
struct CameraCalibration {
  /// Camera of the raw images.
  Camera camera;
  /// RMS residual over all corners of the views used, pixels.
  double rms_px = 0;
  /// Standard deviations of focal length and principal point, pixels; the larger of x and y.
  double sigma_f_px = 0, sigma_c_px = 0;
  /// The views used.
  std::vector<ViewFit> views;
  /// Frames of the rejected views.
  std::vector<int> skipped;
  /// What further views would add, a sentence each; empty: nothing.
  std::vector<std::string> lacking;
};

/// Throws InputError, opened by `where`: fewer than eight views; views that do not determine the focal length
/// (the board was never tilted); residuals too large for this lens model. Cost: under a second for 20 views
/// of 54 corners, half a minute for 60.
CameraCalibration calibrate_camera(const BoardViews& views, const std::string& where);

}  // namespace edgevo
