// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Motion of an image point under a correction of the camera file (ImageCorrection, core/camera.h):
//   1. another focal length, and a residual radial distortion k1 (core/radial.h),
//   2. a rolling shutter: row v is exposed readout_s (v / (height - 1) - 1/2) seconds after the middle row,
//      whose time is that of the frame. An image point x that moves with dx/dt (image_motion.h) appears at
//          x + t dx/dt + t^2 / 2 d2x/dt2,   t = readout_s row,   row = v / (height - 1) - 1/2,
//      where the second term is known with a gyro only.
// Together: x_file = (1 + focal) add_radial(k1, x + t dx/dt + ...), normalised coordinates. The row v
// is that of the raw pixel at which the moved point appears; on the way there rows are taken as evenly
// spaced, which together with the neglected k1 costs a per cent of a shift of a few pixels, and so do the
// depths of image_motion.h.
#include <Eigen/Core>

#include "edgevo/core/rectification.h"
#include "edgevo/edges/image_motion.h"

namespace edgevo {

/// Read-out time by the rows that a camera with the file's focal length shows, which add_rolling() takes: the
/// true camera's are further from the middle one by 1 + focal.
inline double row_time(const ImageCorrection& c) { return (1 + c.focal) * c.readout_s; }

/// Row of the raw image at which the camera shows a normalised image point, as a share of the height: -1/2 at
/// the top and 1/2 at the bottom.
double shutter_row(const Camera& camera, const Eigen::Vector2d& x);

/// Position at which the rolling shutter alone shows the point x, normalised coordinates; `row_time_s`:
/// row_time().
Eigen::Vector2d add_rolling(const Rectification& rectification, double row_time_s, const ImageMotion& motion,
                            const Eigen::Vector2d& x);
/// Derivative of add_rolling() by row_time_s.
Eigen::Vector2d rolling_rate(const Rectification& rectification, double row_time_s, const ImageMotion& motion,
                             const Eigen::Vector2d& x);
/// Distorted position x_file of a true x, normalised coordinates.
Eigen::Vector2d to_file(const Rectification& rectification, const ImageCorrection& correction,
                        const ImageMotion& motion, const Eigen::Vector2d& x);
/// Inverse of to_file(), to 1e-12 if the image moves by less than a fifth of its height during the read-out;
/// at most 12 steps. If it moves so fast that the iteration diverges, only the lens is corrected.
Eigen::Vector2d from_file(const Rectification& rectification, const ImageCorrection& correction,
                          const ImageMotion& motion, const Eigen::Vector2d& x_file);
/// Jacobian d x_file / d x; the part of the rolling shutter is computed by differences.
Eigen::Matrix2d file_jacobian(const Rectification& rectification, const ImageCorrection& correction,
                              const ImageMotion& motion, const Eigen::Vector2d& x);

}  // namespace edgevo
