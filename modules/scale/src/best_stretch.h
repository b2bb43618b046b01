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

/// What white noise gains in -2 ln of its probability by the best of all stretches of so many values, each
/// with a mean of `axes` components of its own (the Bayesian information criterion).
double gain_by_chance(double values, double axes);

/// Whether values of one component gain more than that.
bool stands_out(const Stretch& stretch, const std::vector<Eigen::Vector3d>& values);

}  // namespace edgevo
