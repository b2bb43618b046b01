#pragma once
// One plumb-bob lens for a camera whose residual distortion was found by self-calibration, so that any
// program can use it.
//
// Camera::distort first applies residual_k1 (core/radial.h), then the file's plumb-bob coefficients; other
// programs know only the latter. Their product is a polynomial of three times the degree, and the five
// coefficients that follow it best are a LINEAR least-squares problem over the true rays x of the image:
//     x_d - x = x (k1 r^2 + k2 r^4 + k3 r^6) + tangential(p1, p2),   in pixels
// Where the file has no distortion the answer is exact: k1 = residual_k1. For the strong lens of TUM's
// freiburg1 and a residual of 0.01, which moves the corner by 2.9 px, 0.009 px rms and 0.10 px in the corner
// remain: the price of a model that everybody reads.
#include <string>

#include "edgevo/core/camera.h"

namespace edgevo {

/// The camera for other programs, and what the fold costs.
struct FoldedCamera {
  Camera camera;  ///< same pinhole, residual_k1 = 0
  /// Distance over the image between the two lens models, pixels of the distorted image.
  double rms_error_px = 0;
  double max_error_px = 0;  ///< the largest such distance; it stands in a corner
  double max_shift_px = 0;  ///< what residual_k1 moves at most over the image, pixels of the distorted image
};

/// The error is taken over a grid of about 50 lines over the shorter side, borders included. Throws
/// InputError opened by `where` when the camera's lens model cannot be inverted over most of the image. Cost:
/// a millisecond.
FoldedCamera fold_residual(const Camera& camera, const std::string& where);

}  // namespace edgevo
