// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// OpenCV's calibrations of three lens models from views of a board.
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edgevo/calibration/calibrate_camera.h"

namespace edgevo {

/// A lens and the poses of the board, fitted to the views.
struct LensSolution {
  CalibratedLens kind = CalibratedLens::kPlumbBob;
  cv::Mat K, lens;
  std::vector<cv::Vec3d> rotations, translations;
  /// Standard deviations of fx, fy, cx, cy, pixels.
  cv::Vec4d sigmas;
  double rms_px = 0;

  /// The camera of images of this size.
  Camera camera(int width, int height) const;
  /// Pixels of the corners of view `i`.
  std::vector<cv::Point2d> project(const BoardView& view, size_t i) const;
  /// Number of coefficients that were fitted, focal lengths and principal point included.
  int parameters() const;
};

/// Fits one model. Nullopt where OpenCV finds no solution, or one that does not show some of the corners.
std::optional<LensSolution> solve_lens(CalibratedLens kind, const std::vector<BoardView>& views, int width,
                                       int height);

}  // namespace edgevo
