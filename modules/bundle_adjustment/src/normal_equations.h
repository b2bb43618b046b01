#pragma once
// Normal equations of a packed problem: one pass over the observations gives the robust cost, the pose
// system, and the Schur complement of the inverse depths.
//
// All sums are first taken per (host, target) pair in the target's own perturbation; since J_host = -J_target
// Ad(T_t_h), the blocks of the world poses follow by congruence, once a pair and not once an observation.
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

/// Poses' 6x6 blocks are ordered as the problem's poses, fixed ones included. H and S are symmetric and full.
struct NormalEquations {
  double cost = 0;    ///< sum of Huber costs
  Eigen::MatrixXd H;  ///< sum w J^T J over poses
  Eigen::VectorXd b;  ///< sum w J^T r
  Eigen::MatrixXd S;  ///< sum over free points E E^T / information: H - S is the Schur complement
  Eigen::VectorXd s;  ///< sum over free points E gradient / information
  std::vector<double> idepth_information;  ///< per packed point, sum w (dr/drho)^2
  std::vector<double> idepth_gradient;     ///< per packed point, sum w r dr/drho
  std::vector<PackedVector6> coupling;     ///< per packed observation, E = sum w J_target^T dr/drho
  /// Of T_target_host, host * n + target in the host's range: J_host = -J_target Ad.
  std::vector<Matrix6d> adjoint;
};

/// Information, 1 over the square of an inverse depth, below which a point's depth is held: no parallax,
/// nothing to divide by. A deviation of a million says nothing in a map whose depths are about ten.
constexpr double kMinIdepthInformation = 1e-12;

/// Scratch of the pass, kept between iterations so that the hot loop never allocates.
class NormalEquationsBuilder {
 public:
  NormalEquationsBuilder(const PackedProblem& packed, double huber_width);
  void build(const State& state, NormalEquations* out);
  /// Only the cost and the sums of single depths (idepth_information, idepth_gradient), the same bits as
  /// `build` gives; the rest of `out` is not touched. A fraction of the time of `build`.
  void build_cost_and_depths(const State& state, NormalEquations* out);

 private:
  struct Derivatives;
  /// Both rows of all observations of a (host, target) pair, the lanes to be added up at the end.
  struct PairSums {
    Rows H[21];  ///< upper triangle of a 6x6 matrix, row by row
    Rows b[6];
  };
  static Matrix6d to_matrix(const PairSums& sums);
  static Matrix6d to_matrix(const SchurBlock& block);
  static void add_to_pair(const Derivatives& d, PairSums* sums);

  enum class Sums { kAll, kCostAndDepths };

  void reset(const State& state, NormalEquations* out);
  void reset_cost_and_depths(const State& state, NormalEquations* out);
  bool differentiate(const RelativePose& T, const PackedPoint& point, double idepth,
                     const PackedObservation& o, Derivatives* d) const;
  template <Sums wanted>
  void add_point(const PackedPoint& point, int host, int point_index, double idepth, NormalEquations* out);
  void eliminate(const PackedPoint& point, int point_index, NormalEquations* out);
  void scatter_pairs(int host, NormalEquations* out);
  void scatter_schur(int host, NormalEquations* out);

  const PackedProblem& packed_;
  double huber_width_;
  int n_;
  std::vector<RelativePose> relative_;  ///< host * n + target
  std::vector<PairSums> pairs_;         ///< host * n + target
  std::vector<SchurBlock> schur_;       ///< of the host at hand: target_row * n + target_col, row >= col
  std::vector<PackedVector6> schur_b_;  ///< of the host at hand, per target
};

}  // namespace edgevo::ba
