#pragma once
// How fast image points move at one moment, everywhere in the image: what the rows of a rolling shutter need
// to know.
//
// A camera that moves by the twist (v, w) sees a point X of its frame move by dX/dt = v + w x X, and with the
// inverse depth rho the normalised image point x = (X/Z, Y/Z) by
//     dx/dt = (rho v + w x (x, y, 1))_xy - x (rho v + w x (x, y, 1))_z.
// rho is a coarse picture of the depths in view, and need not be exact for each edge point: at 0.3 m/s, 1 m
// from the camera and 520 px of focal length, an error by a third is one of 50 px/s, and a quarter of a pixel
// where a shutter of 0.02 s is halfway to the border.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// The motion of the camera at one moment, with the depths in view.
struct ImageMotion {
  /// Cells of the image: a coarse picture of the depths will do.
  static constexpr int kRows = 8, kColumns = 10;

  /// (v, w) of points in the camera frame, units and radians a second; 0: not known.
  Vector6d velocity = Vector6d::Zero();
  /// At the cells' centres.
  Eigen::Matrix<double, kRows, kColumns> idepth = Eigen::Matrix<double, kRows, kColumns>::Zero();

  bool is_known() const { return !velocity.isZero(0); }  ///< `velocity` is not zero
  /// dx/dt of the normalised image point x, per second; depths between the cells' centres bilinear.
  Eigen::Vector2d at(const Pinhole& pinhole, const Eigen::Vector2d& x) const;
};

}  // namespace edgevo
