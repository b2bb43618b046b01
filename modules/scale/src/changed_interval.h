// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace edgevo {

/// Values begin to end - 1 of a series.
struct IndexInterval {
  size_t begin = 0, end = 0;
};

/// The interval whose mean differs most from that of the other values, in standard errors of white noise.
/// Within 1/64 of the series. Cost: a few microseconds.
IndexInterval changed_interval(const std::vector<Eigen::Vector3d>& values);

/// What white noise gains in -2 ln of its probability by the best of all intervals of so many values, each
/// with a mean of `axes` components of its own (the Bayesian information criterion).
double gain_by_chance(double values, double axes);

/// Whether values of one component gain more than that.
bool stands_out(const IndexInterval& interval, const std::vector<Eigen::Vector3d>& values);

}  // namespace edgevo
