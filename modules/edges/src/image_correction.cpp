// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/image_correction.h"

#include "edgevo/core/radial.h"

namespace edgevo {
namespace {

// Each step reduces the error to about the share of its height that the image moves during the read-out.
constexpr int kMostSteps = 12;
// Normalised coordinates: the iteration has converged, with a margin to the documented 1e-12.
constexpr double kErrorSquare = 1e-26;
// Step of numeric differences, normalised coordinates: a hundredth of a pixel, much less than a cell of the
// motion.
constexpr double kDifference = 1e-5;

}  // namespace

Eigen::Vector2d add_rolling(const Pinhole& c, double readout_s, const ImageMotion& motion,
                            const Eigen::Vector2d& x) {
  if (readout_s == 0 || !motion.is_known()) return x;
  return x + readout_s * shutter_row(c, x) * motion.at(c, x);
}

Eigen::Vector2d to_file(const Pinhole& c, const ImageCorrection& correction, const ImageMotion& motion,
                        const Eigen::Vector2d& x) {
  return add_radial(correction.k1, add_rolling(c, correction.readout_s, motion, x));
}

Eigen::Vector2d from_file(const Pinhole& c, const ImageCorrection& correction, const ImageMotion& motion,
                          const Eigen::Vector2d& x_file) {
  const Eigen::Vector2d rolling = remove_radial(correction.k1, x_file);
  if (correction.readout_s == 0 || !motion.is_known()) return rolling;
  Eigen::Vector2d x = rolling;
  double at_first = -1, at_last = 0;
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector2d error = add_rolling(c, correction.readout_s, motion, x) - rolling;
    x -= error;
    at_last = error.squaredNorm();
    if (at_first < 0) at_first = at_last;
    if (at_last < kErrorSquare) break;
  }
  return at_last <= at_first ? x : rolling;  // rolling: the rows overtake one another, so x is not unique
}

Eigen::Matrix2d file_jacobian(const Pinhole& c, const ImageCorrection& correction, const ImageMotion& motion,
                              const Eigen::Vector2d& x) {
  const Eigen::Matrix2d radial =
      radial_jacobian(correction.k1, add_rolling(c, correction.readout_s, motion, x));
  if (correction.readout_s == 0 || !motion.is_known()) return radial;
  Eigen::Matrix2d rolling;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = kDifference * Eigen::Vector2d::Unit(axis);
    rolling.col(axis) = (add_rolling(c, correction.readout_s, motion, x + step) -
                         add_rolling(c, correction.readout_s, motion, x - step)) /
                        (2 * kDifference);
  }
  return radial * rolling;
}

}  // namespace edgevo
