// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Everything about a camera that its file may have wrong, as unknowns of an adjustment:
//     x_file = (1 + focal) x' (1 + k1 r^2 + k2 r^4) + centre,   r = |x'|
// in normalised coordinates, with x' the true point x where the rolling shutter shows it
// (image_correction.h). A run corrects k1, focal length and read-out time; the others are for a new camera
// file.
#include <Eigen/Core>

#include "edgevo/bundle_adjustment/profile.h"
#include "edgevo/edges/image_correction.h"

namespace edgevo {

/// Index of each unknown.
enum CameraUnknown { kK1, kReadout, kK2, kFocal, kCentreX, kCentreY };
static_assert(kCentreY + 1 == ba::kUnknowns);

/// A number for each unknown; `centre` for both coordinates.
inline ba::Unknowns of_each(double k1, double readout, double k2, double focal, double centre) {
  ba::Unknowns k;
  k << k1, readout, k2, focal, centre, centre;
  return k;
}

/// Which unknowns are free.
using CameraMask = Eigen::Array<bool, ba::kUnknowns, 1>;

/// The mask with these alone.
inline CameraMask only(std::initializer_list<CameraUnknown> free) {
  CameraMask mask = CameraMask::Constant(false);
  for (const CameraUnknown u : free) mask[u] = true;
  return mask;
}

/// The error of a camera file.
struct CameraError {
  /// What a run corrects.
  ImageCorrection correction;
  /// Second radial coefficient.
  double k2 = 0;
  /// The true principal point less that of the file, over the file's focal length.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();

  CameraError() = default;
  /// Only what a run corrects.
  CameraError(const ImageCorrection& c) : correction(c) {}
  /// From the vector of unknowns.
  explicit CameraError(const ba::Unknowns& k)
      : correction{k[kK1], k[kReadout], k[kFocal]}, k2(k[kK2]), centre(k[kCentreX], k[kCentreY]) {}
  /// As the vector of unknowns.
  ba::Unknowns unknowns() const {
    ba::Unknowns k;
    k << correction.k1, correction.readout_s, k2, correction.focal, centre.x(), centre.y();
    return k;
  }

  /// x_file of a true point x.
  Eigen::Vector2d to_file(const Rectification& r, const ImageMotion& motion, const Eigen::Vector2d& x) const;
  /// Inverse of to_file(), as exact as edgevo::from_file().
  Eigen::Vector2d from_file(const Rectification& r, const ImageMotion& motion,
                            const Eigen::Vector2d& x_file) const;
  /// Jacobian d x_file / d x.
  Eigen::Matrix2d jacobian(const Rectification& r, const ImageMotion& motion, const Eigen::Vector2d& x) const;
  /// Derivative d x_file / d k at a true point x.
  ba::ImageRate derivative(const Rectification& r, const ImageMotion& motion, const Eigen::Vector2d& x) const;
};

}  // namespace edgevo
