// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace edgevo {

/// Radians of an angle in degrees.
constexpr double rad(double degrees) { return degrees * (3.14159265358979323846 / 180); }

/// Degrees of an angle in radians.
constexpr double deg(double radians) { return (180 / 3.14159265358979323846) * radians; }

}  // namespace edgevo
