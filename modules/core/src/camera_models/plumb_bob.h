// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Plumb-bob distortion of normalised coordinates.
#include <optional>

#include "edgevo/core/camera_models.h"

namespace edgevo {

/// Distorted x.
Eigen::Vector2d distort(const Distortion& d, const Eigen::Vector2d& x);
/// d distort / d x, symmetric.
Eigen::Matrix2d distortion_jacobian(const Distortion& d, const Eigen::Vector2d& x);
/// Whether distort() is one-to-one on the disc of this radius, with a margin (kMinSlope). False for NaN.
bool is_in_range(const Distortion& d, double radius);
/// Angle whose tangent is the largest radius that is_in_range(), radians.
double range_angle(const Distortion& d);
/// Inverse of distort() within its range; nullopt beyond it.
std::optional<Eigen::Vector2d> undistort(const Distortion& d, const Eigen::Vector2d& x_d);

}  // namespace edgevo
