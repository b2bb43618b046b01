// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Velocity of image points at one time, everywhere in the image, as needed to rectify a rolling shutter.
//
// If points X in the camera frame move by dX/dt = v + w x X, the normalised image point x = (X/Z, Y/Z) with
// the inverse depth rho moves by
//     dx/dt = (rho v + w x (x, y, 1))_xy - x (rho v + w x (x, y, 1))_z.
// rho is a coarse map of the depths in view and need not be exact for each edge point: at 0.3 m/s, 1 m from
// the camera and 520 px of focal length, an error of a third causes 50 px/s, a quarter of a pixel halfway to
// the border for a read-out time of 0.02 s.
//
// Over a read-out in which the rate of rotation changes, a point moves by t dx/dt + t^2 / 2 d2x/dt2, with
// d2X/dt2 = dw/dt x X + w x dX/dt. A hand that shakes twice a second by 0.2 rad changes it by 30 rad/s^2:
// 1.8 px at the ends of a read-out of 0.03 s. The velocity v is taken as constant in the camera's axes.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Motion of the camera at one time, with the depths in view.
struct ImageMotion {
  /// Number of cells of the coarse depth map.
  static constexpr int kRows = 8, kColumns = 10;

  /// Velocity (v, w) of points in the camera frame, units of the map and radians per second; 0 if unknown.
  Vector6d velocity = Vector6d::Zero();
  /// Inverse depth at the centres of the cells.
  Eigen::Matrix<double, kRows, kColumns> idepth = Eigen::Matrix<double, kRows, kColumns>::Zero();
  /// Change dw/dt of the rate of rotation, rad/s^2; 0 if unknown: only a gyro shows it.
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();

  /// Whether the velocity is known (not zero).
  bool is_known() const { return !velocity.isZero(0); }
  /// Velocity dx/dt of the normalised image point x, per second; depths are interpolated bilinearly.
  Eigen::Vector2d at(const Pinhole& pinhole, const Eigen::Vector2d& x) const;
  /// Its acceleration d2x/dt2 where `turning` is known; else 0.
  Eigen::Vector2d acceleration(const Pinhole& pinhole, const Eigen::Vector2d& x) const;

 private:
  Eigen::Vector3d rate(const Pinhole& pinhole, const Eigen::Vector2d& x) const;
};

}  // namespace edgevo
