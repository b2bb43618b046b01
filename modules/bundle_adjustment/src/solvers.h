// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two solvers of make_bundle_adjuster(), and shared code for their results.
#include <memory>

#include "packed_problem.h"

namespace edgevo::ba {

std::unique_ptr<BundleAdjuster> make_schur_solver();
std::unique_ptr<BundleAdjuster> make_ceres_solver();

/// Result of a problem that is not solved: usable = false, residuals at the input.
BaResult unusable_result(const BaProblem& problem);
/// Fills in residuals and validity of all observations at the current values of `problem`.
void fill_residuals(const BaProblem& problem, BaResult* result);
/// Fills in the standard deviations 1 / sqrt(information) of the free points of the packed problem.
void fill_sigmas(const PackedProblem& packed, const std::vector<double>& idepth_information,
                 std::size_t point_count, BaResult* result);
/// Writes the free poses and depths of `state` into `problem`.
void store(const State& state, BaProblem* problem);

}  // namespace edgevo::ba
