// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace edgevo {

/// Median of the square of a normal vector of three components, in variances.
constexpr double kMedianChiSquare = 2.366;

}  // namespace edgevo
