#pragma once
// The two solvers behind make_bundle_adjuster, and what their results share.
#include <memory>

#include "packed_problem.h"

namespace edgevo::ba {

std::unique_ptr<BundleAdjuster> make_schur_solver();
std::unique_ptr<BundleAdjuster> make_ceres_solver();

/// For a problem that is not solved: usable = false, residuals at the input.
BaResult unusable_result(const BaProblem& problem);
/// Residuals and validity of all observations of `problem` as it stands.
void fill_residuals(const BaProblem& problem, BaResult* result);
/// 1 / sqrt(information) for the free points of the packed problem.
void fill_sigmas(const PackedProblem& packed, const std::vector<double>& idepth_information,
                 std::size_t point_count, BaResult* result);
/// Writes the free poses and depths of `state` back.
void store(const State& state, BaProblem* problem);

}  // namespace edgevo::ba
