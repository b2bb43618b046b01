// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Positions of satellite navigation in metres.
#include <Eigen/Core>
#include <cmath>

#include "edgevo/core/angle.h"

namespace edgevo {

/// A position from the centre of the earth, metres: x towards latitude and longitude 0, z towards the north
/// pole. By WGS84's ellipsoid; `height_m` is above it.
inline Eigen::Vector3d earth_centred(double latitude_deg, double longitude_deg, double height_m) {
  constexpr double kEquator = 6378137.0, kFlattening = 1 / 298.257223563;  // radius, metres
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double sin_lat = std::sin(rad(latitude_deg)), cos_lat = std::cos(rad(latitude_deg));
  const double across =
      kEquator / std::sqrt(1 - kEccentricity2 * sin_lat * sin_lat);  // radius of the prime vertical
  return {(across + height_m) * cos_lat * std::cos(rad(longitude_deg)),
          (across + height_m) * cos_lat * std::sin(rad(longitude_deg)),
          (across * (1 - kEccentricity2) + height_m) * sin_lat};
}

}  // namespace edgevo
