// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A camera and its lens from views of a board (Zhang, "A Flexible New Technique for Camera Calibration", as
// implemented in OpenCV), with the means to assess them: residuals, standard deviations, and what the
// views lack.
//
// Views whose residuals exceed three times those of the median view are rejected once (a blurred image, a
// wrong corner). The coefficient k3 is used only where it differs from 0 by three of its standard deviations:
// with few views it fits noise and distorts the corners of the image.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/calibration/board_views.h"
#include "edgevo/core/camera.h"

namespace edgevo {

/// Lens models that are calibrated: plumb-bob, Kannala-Brandt, rational without thin prism.
enum class CalibratedLens { kPlumbBob, kFisheye, kRational };

/// "plumb_bob", "fisheye", "rational".
const char* to_string(CalibratedLens lens);

/// A lens model that was tried, with the RMS of its residuals, pixels; NaN if it does not fit at all.
struct TriedLens {
  /// The lens model.
  CalibratedLens lens = CalibratedLens::kPlumbBob;
  /// RMS of the residuals, pixels.
  double rms_px = 0;
};

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
  /// The models that were tried.
  std::vector<TriedLens> tried;
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

/// `lens`: the model; nullopt: plumb-bob, unless another one has clearly smaller residuals than its
/// additional coefficients explain. Throws InputError, opened by `where`: fewer than eight views; views that
/// do not determine the focal length (the board was never tilted); residuals too large for this lens model.
/// Cost: under a second for 20 views of 54 corners, half a minute for 60; three times as much for all models.
CameraCalibration calibrate_camera(const BoardViews& views, const std::string& where,
                                   std::optional<CalibratedLens> lens = std::nullopt);

}  // namespace edgevo
