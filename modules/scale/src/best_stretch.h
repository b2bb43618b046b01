// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace edgevo {

/// Values begin to end - 1 of a series.
struct Stretch {
  size_t begin = 0, end = 0;
};

/// The stretch whose mean differs most from that of the other values, in standard errors of white noise.
/// Within 1/64 of the series. Cost: a few microseconds.
Stretch best_stretch(const std::vector<Eigen::Vector3d>& values);

}  // namespace edgevo
