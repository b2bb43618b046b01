// SPDX-License-Identifier: BSD-3-Clause
#include "camera_error.h"

#include "edgevo/core/radial.h"

namespace edgevo {

using Eigen::Vector2d;

Vector2d CameraError::to_file(const Rectification& r, const ImageMotion& motion, const Vector2d& x) const {
  const Vector2d rolling = add_rolling(r, row_time(correction), motion, x);
  return (1 + correction.focal) * add_radial(correction.k1, rolling, k2) + centre;
}

Vector2d CameraError::from_file(const Rectification& r, const ImageMotion& motion,
                                const Vector2d& x_file) const {
  const Vector2d radial = (x_file - centre) / (1 + correction.focal);
  const ImageCorrection rolling{0, row_time(correction)};
  return edgevo::from_file(r, rolling, motion, remove_radial(correction.k1, radial, k2));
}

Eigen::Matrix2d CameraError::jacobian(const Rectification& r, const ImageMotion& motion,
                                      const Vector2d& x) const {
  const ImageCorrection rolling{0, row_time(correction)};
  return (1 + correction.focal) *
         radial_jacobian(correction.k1, add_rolling(r, row_time(correction), motion, x), k2) *
         file_jacobian(r, rolling, motion, x);
}

ba::ImageRate CameraError::derivative(const Rectification& r, const ImageMotion& motion,
                                      const Vector2d& x) const {
  const Vector2d rolling = add_rolling(r, row_time(correction), motion, x);
  const double r2 = rolling.squaredNorm(), f = 1 + correction.focal;
  const Vector2d by_row_time =
      f * radial_jacobian(correction.k1, rolling, k2) * rolling_rate(r, row_time(correction), motion, x);
  ba::ImageRate d;
  d.col(kK1) = f * radial_derivative(rolling);
  d.col(kReadout) = f * by_row_time;
  d.col(kK2) = f * r2 * r2 * rolling;
  d.col(kFocal) = add_radial(correction.k1, rolling, k2) + correction.readout_s * by_row_time;
  d.col(kCentreX) = Vector2d::UnitX();
  d.col(kCentreY) = Vector2d::UnitY();
  return d;
}

}  // namespace edgevo
