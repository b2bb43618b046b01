#pragma once
// Symmetric systems of normal equations.
#include <Eigen/Cholesky>

namespace edgevo::ba {

/// A x = b for a symmetric A that is positive definite as a rule: Cholesky, which Eigen does block by block; the slow factorisation
/// without square roots only where that fails.
inline Eigen::VectorXd solve_positive(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::LLT<Eigen::MatrixXd> llt(A);
  if (llt.info() == Eigen::Success) return llt.solve(b);
  return A.ldlt().solve(b);
}

}  // namespace edgevo::ba
