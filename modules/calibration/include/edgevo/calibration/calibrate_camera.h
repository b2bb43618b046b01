#pragma once
// Pinhole and plumb-bob lens from views of a board (Zhang, "A Flexible New Technique for Camera Calibration",
// as OpenCV has it), with what tells whether to believe them: residuals, standard deviations, and what the
// views lack.
//
// Views whose residuals are three times those of the median view are left out once (a blurred image, a wrong
// corner). The coefficient k3 is used only where it differs from 0 by three of its standard deviations: with
// few views it fits their noise and bends the corners of the image.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "edgevo/calibration/board_views.h"
#include "edgevo/core/camera.h"

namespace edgevo {

/// How well one view fits the camera.
struct ViewFit {
  int frame = 0;  ///< of the image in its source
  double rms_px = 0;  ///< of its residuals
  std::vector<Eigen::Vector2f> px;           ///< corners as found
  std::vector<Eigen::Vector2f> residual_px;  ///< found minus projected
  Eigen::Vector3d normal_cam;                ///< of the board, unit length, z > 0
};

/// A camera, and what tells whether to believe it.
struct CameraCalibration {
  Camera camera;  ///< of the raw images
  double rms_px = 0;                      ///< over all corners of the views used
  double sigma_f_px = 0, sigma_c_px = 0;  ///< one standard deviation; the larger of x and y
  std::vector<ViewFit> views;             ///< those used
  std::vector<int> left_out;              ///< frames of those not used
  std::vector<std::string> lacking;       ///< what other views would add, a sentence each; empty: nothing
};

/// Throws InputError, opened by `where`: fewer than eight views; views that do not determine the focal length
/// (the board was never tilted); residuals that no such lens leaves. Cost: under a second for 20 views of 54
/// corners, half a minute for 60.
CameraCalibration calibrate_camera(const BoardViews& views, const std::string& where);

}  // namespace edgevo
