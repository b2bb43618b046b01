// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One plumb-bob lens for a camera whose residual distortion and focal length were found by self-calibration,
// so that any program can use it.
//
// A run first applies the k1 that it found (core/radial.h), then the file's plumb-bob coefficients; other
// programs know only the latter. Their product is a polynomial of three times the degree, and the five
// coefficients that follow it best are a LINEAR least-squares problem over the true rays x of the image:
//     x_d - x = x (k1 r^2 + k2 r^4 + k3 r^6) + tangential(p1, p2),   in pixels of the true focal length
// Where the file has no distortion the answer is exact: that k1. For the strong lens of TUM's
// freiburg1 and a residual of 0.01, which moves the corner by 2.9 px, 0.009 px rms and 0.10 px in the corner
// remain: the price of a model that every program reads.
#include <string>

#include "edgevo/core/camera.h"

namespace edgevo {

/// A camera without residual distortion, and the error of folding it in.
struct FoldedCamera {
  /// Camera with the true focal length, whose lens includes the residual distortion.
  Camera camera;
  /// RMS distance over the image between the two lens models, pixels of the distorted image.
  double rms_error_px = 0;
  /// Largest distance between the two lens models, pixels of the distorted image; attained in a corner.
  double max_error_px = 0;
  /// Largest shift by what the file has wrong over the image, pixels of the distorted image.
  double max_shift_px = 0;
};

/// Folds k1 and focal length of `residual` into those of the camera. The error is evaluated on a
/// grid of about 50 lines over the shorter side, borders included. Throws InputError opened by `where` when
/// the camera's lens model cannot be inverted over most of the image. Cost: a millisecond.
FoldedCamera fold_residual(const Camera& camera, const ImageCorrection& residual, const std::string& where);

}  // namespace edgevo
