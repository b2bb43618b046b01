// SPDX-License-Identifier: BSD-3-Clause
// Symmetric systems: the band is found and used, and the result equals that of the whole matrix.
#include "dense_solve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace edgevo::ba {
namespace {

// Symmetric with entries up to `width` from the diagonal, whose weight makes it positive definite.
Eigen::MatrixXd band_matrix(Eigen::Index n, Eigen::Index width, double diagonal) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - width); j <= i; ++j)
      A(i, j) = A(j, i) = i == j ? diagonal : std::sin(double(3 * i + 7 * j));
  return A;
}

Eigen::VectorXd right_side(Eigen::Index n) {
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) b[i] = std::cos(double(i));
  return b;
}

TEST(DenseSolve, FindsTheBand) {
  EXPECT_EQ(half_bandwidth(Eigen::MatrixXd::Identity(7, 7)), 0);
  for (Eigen::Index width : {1, 5, 6}) EXPECT_EQ(half_bandwidth(band_matrix(7, width, 1)), width);
  Eigen::MatrixXd corner = Eigen::MatrixXd::Identity(9, 9);
  corner(8, 0) = corner(0, 8) = 1e-30;
  EXPECT_EQ(half_bandwidth(corner), 8);
  EXPECT_EQ(half_bandwidth(Eigen::MatrixXd()), 0);
}

// Sizes around the blocks of the factorisation, bands narrower and wider than a block, and full matrices.
TEST(DenseSolve, SolvesBandsAndFullMatrices) {
  for (Eigen::Index n : {1, 6, 47, 48, 49, 96, 150, 331})
    for (Eigen::Index width : {0, 1, 11, 47, 48, 90, 331}) {
      const Eigen::MatrixXd A = band_matrix(n, std::min(width, n - 1), 2.0 * double(width) + 2);
      const Eigen::VectorXd b = right_side(n), x = solve_positive(A, b);
      EXPECT_LT((A * x - b).norm(), 1e-10 * b.norm()) << n << " " << width;
    }
  EXPECT_EQ(solve_positive(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)).size(), 0);
}

TEST(DenseSolve, SolvesIndefiniteMatricesToo) {
  Eigen::MatrixXd A = band_matrix(120, 12, 30);
  A(77, 77) = -30;
  const Eigen::VectorXd b = right_side(120);
  EXPECT_LT((A * solve_positive(A, b) - b).norm(), 1e-9 * b.norm());
}

}  // namespace
}  // namespace edgevo::ba
