#pragma once
// How an image point moves when what the camera file does not say (ImageCorrection, core/camera.h) is taken
// out:
//   1. a residual radial distortion k1 (core/radial.h),
//   2. a rolling shutter: row v is taken readout_s (v / (height - 1) - 1/2) seconds after the row in the
//      middle, whose moment is the frame's. An image point x that moves with dx/dt (image_motion.h) is found
//      at
//          x + readout_s row(x) dx/dt,   row(x) = v / (height - 1) - 1/2.
// Together: x_file = add_radial(k1, x + readout_s row(x) dx/dt), normalised coordinates. The row is that of x
// and not that of the raw image, the depths are those of image_motion.h: both are wrong by a few per cent of
// a shift of a few pixels.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/edges/image_motion.h"

namespace edgevo {

/// Row of a normalised image point as a share of the height, -1/2 at the top and 1/2 at the bottom.
inline double shutter_row(const Pinhole& c, const Eigen::Vector2d& x) {
  return c.height > 1 ? (c.fy * x.y() + c.cy) / (c.height - 1) - 0.5 : 0.0;
}

/// Where the rolling shutter alone shows the point x.
Eigen::Vector2d add_rolling(const Pinhole& pinhole, double readout_s, const ImageMotion& motion,
                            const Eigen::Vector2d& x);
/// x_file of a true x.
Eigen::Vector2d to_file(const Pinhole& pinhole, const ImageCorrection& correction, const ImageMotion& motion,
                        const Eigen::Vector2d& x);
/// Inverse of to_file, to 1e-12 where the image moves by less than a fifth of its height while it is read; at
/// most 12 steps. Where it moves so fast that the steps lead away, the lens alone is taken out.
Eigen::Vector2d from_file(const Pinhole& pinhole, const ImageCorrection& correction,
                          const ImageMotion& motion, const Eigen::Vector2d& x_file);
/// d x_file / d x; the rolling shutter's share by differences.
Eigen::Matrix2d file_jacobian(const Pinhole& pinhole, const ImageCorrection& correction,
                              const ImageMotion& motion, const Eigen::Vector2d& x);

}  // namespace edgevo
