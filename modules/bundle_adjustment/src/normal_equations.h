// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Normal equations of a packed problem: a single loop over the observations computes the robust cost, the
// pose system and the Schur complement of the inverse depths.
//
// All sums are first taken per (host, target) pair in the target's own perturbation; since J_host = -J_target
// Ad(T_t_h), the blocks of the world poses follow by congruence, once per pair instead of per observation.
#include <vector>

#include "packed_problem.h"

namespace edgevo::ba {

/// Six doubles in three registers.
struct PackedVector6 {
  Rows x[3];
};

/// Four doubles: one register with AVX2, two without.
using Quad = double __attribute__((vector_size(32)));

/// A 6x6 matrix, row by row. Without AVX the compiler would align a Quad to sixteen bytes only.
struct alignas(32) SchurBlock {
  Quad quad[9];
};

/// Sums over both rows of all observations of a (host, target) pair. A quad holds both rows of one unknown of
/// the target's pose, then both rows of the next one; the rows are added at the end.
struct alignas(32) PairSums {
  /// Row i of the 6x6 matrix, in quads, from the one with its diagonal on.
  Quad H[12];
  Quad b[3];
};

/// A 6x6 matrix stored row by row.
using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// Normal equations. The 6x6 blocks are in the order of the problem's poses, including fixed ones. H and S
/// are full symmetric matrices.
struct NormalEquations {
  /// Sum of Huber costs.
  double cost = 0;
  /// Sum w J^T J over poses.
  Eigen::MatrixXd H;
  /// Sum w J^T r.
  Eigen::VectorXd b;
  /// Sum over free points E E^T / information: H - S is the Schur complement.
  Eigen::MatrixXd S;
  /// Sum over free points E gradient / information.
  Eigen::VectorXd s;
  /// Per packed point, sum w (dr/drho)^2.
  std::vector<double> idepth_information;
  /// Per packed point, sum w r dr/drho.
  std::vector<double> idepth_gradient;
  /// Per packed observation, E = sum w J_target^T dr/drho.
  std::vector<PackedVector6> coupling;
  /// Adjoint of T_target_host at host * n + target, for targets in the host's range: J_host = -J_target Ad.
  std::vector<Matrix6d> adjoint;
};

/// Information of an inverse depth below which the depth of a point is fixed: without parallax there is
/// nothing to divide by. It is a standard deviation of a million, in a map whose depths are about ten.
constexpr double kMinIdepthInformation = 1e-12;

/// Builds normal equations; keeps its scratch memory between iterations, so that the hot loop never
/// allocates.
class NormalEquationsBuilder {
 public:
  NormalEquationsBuilder(const PackedProblem& packed, double huber_width);
  void build(const State& state, NormalEquations* out);
  /// Computes only the cost and the sums of single depths (idepth_information, idepth_gradient), with the
  /// same bits as build(), in a fraction of its time; the rest of `out` is unchanged.
  void build_cost_and_depths(const State& state, NormalEquations* out);

 private:
  void reset(const State& state, NormalEquations* out);
  void reset_sums(NormalEquations* out);
  template <class Use>
  void for_each_pair(const State& state, const Use& use);
  template <bool kAll>
  void add_point(const PackedPoint& point, int host, int point_index, double idepth, NormalEquations* out);
  void eliminate(const PackedPoint& point, int point_index, NormalEquations* out);
  void scatter_pairs(int host, NormalEquations* out);
  Matrix6d schur_with_host(int host, int col, const Matrix6d* Ad) const;
  void scatter_schur(int host, NormalEquations* out);

  const PackedProblem& packed_;
  double huber_width_;
  int n_;
  /// T_target_host at host * n + target.
  std::vector<RelativePose> relative_;
  /// Sums at host * n + target.
  std::vector<PairSums> pairs_;
  /// Blocks of S of the current host at target_row * n + target_col, row >= col.
  std::vector<SchurBlock> schur_;
  /// Blocks of s of the current host, per target.
  std::vector<PackedVector6> schur_b_;
  /// Adjoints of the current host, per target.
  std::vector<RowMajor6d> row_major_adjoint_;
};

}  // namespace edgevo::ba
