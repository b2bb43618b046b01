// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Symmetric systems of normal equations.
#include <Eigen/Cholesky>
#include <algorithm>

namespace edgevo::ba {

/// Half bandwidth of a symmetric matrix: |i - j| of the non-zero entry furthest from the diagonal, read from
/// the lower triangle.
inline Eigen::Index half_bandwidth(const Eigen::MatrixXd& A) {
  Eigen::Index width = 0;
  for (Eigen::Index col = 0; col < A.cols(); ++col) {
    Eigen::Index row = A.rows() - 1;
    while (row > col + width && A(row, col) == 0.0) --row;
    width = std::max(width, row - col);
  }
  return width;
}

/// Solves A x = b for a symmetric A that is usually positive definite: Cholesky by blocks and within the
/// band, so that n poses with w neighbours each cost n w^2 instead of n^3; if it fails, the slower LDL^T
/// factorisation.
template <class Columns>
Columns solve_positive(const Eigen::MatrixXd& A, const Columns& b) {
  // Rows: eight poses; a block of 18 KB and its panel stay in the first caches.
  constexpr Eigen::Index kBlock = 48;
  const Eigen::Index n = A.rows(), width = half_bandwidth(A);
  Eigen::MatrixXd L = A;
  Columns x = b;
  // L L^T = A and L y = b, a column of blocks at a time.
  for (Eigen::Index k = 0; k < n; k += kBlock) {
    const Eigen::Index size = std::min(kBlock, n - k), below = std::min(n - k, size + width) - size;
    auto diagonal = L.block(k, k, size, size);
    if (Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(diagonal); llt.info() != Eigen::Success)
      return A.ldlt().solve(b);
    const auto triangle = diagonal.triangularView<Eigen::Lower>();
    auto panel = L.block(k + size, k, below, size);
    triangle.transpose().solveInPlace<Eigen::OnTheRight>(panel);
    L.block(k + size, k + size, below, below).selfadjointView<Eigen::Lower>().rankUpdate(panel, -1.0);
    triangle.solveInPlace(x.middleRows(k, size));
    x.middleRows(k + size, below).noalias() -= panel * x.middleRows(k, size);
  }
  // L^T x = y, backwards.
  for (Eigen::Index k = (n - 1) / kBlock * kBlock; k >= 0; k -= kBlock) {
    const Eigen::Index size = std::min(kBlock, n - k), below = std::min(n - k, size + width) - size;
    x.middleRows(k, size).noalias() -=
        L.block(k + size, k, below, size).transpose() * x.middleRows(k + size, below);
    L.block(k, k, size, size).triangularView<Eigen::Lower>().transpose().solveInPlace(x.middleRows(k, size));
  }
  return x;
}

}  // namespace edgevo::ba
