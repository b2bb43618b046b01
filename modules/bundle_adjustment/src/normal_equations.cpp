// SPDX-License-Identifier: BSD-3-Clause
#include "normal_equations.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "edgevo/core/robust.h"
#include "edgevo/core/simd.h"

// How vectors are passed depends on the target; these functions are only called within this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edgevo::ba {
namespace {

inline Rows both(double x) { return Rows{x, x}; }
// {a[0] + a[1], b[0] + b[1]}
inline Rows sums(Rows a, Rows b) { return Rows{a[0], b[0]} + Rows{a[1], b[1]}; }

inline void add_scaled(double k, const PackedVector6& v, PackedVector6* out) {
  for (int i = 0; i < 3; ++i) out->x[i] += both(k) * v.x[i];
}

Vector6d to_vector(const PackedVector6& v) {
  Vector6d out;
  for (int i = 0; i < 6; ++i) out[i] = v.x[i / 2][i % 2];
  return out;
}

inline Quad quad(Rows a, Rows b) { return Quad{a[0], a[1], b[0], b[1]}; }
inline Quad twice(Rows a) { return quad(a, a); }

// Residual and derivatives of the two rows of an observation, with the robust loss applied.
struct Derivatives {
  Rows r;
  Quad J[3];  // by the target pose, two unknowns each
  Rows J_idepth;
  double weight;
  double cost;
};

// J_target = [s g | p x g] with g = (f0, f1, -f0 u - f1 v), p = (u, v, 1) = Y / Y_z, s = rho / Y_z;  J_idepth
// = g . t / Y_z.
inline bool differentiate(const RelativePose& T, const PackedPoint& point, double idepth,
                          const PackedObservation& o, double huber_width, Derivatives* d) {
  const double x = point.ray[0], y = point.ray[1], z = point.ray[2];
  const double* R = T.R;
  const double* t = T.t;
  const double Y_z = R[6] * x + R[7] * y + R[8] * z + idepth * t[2];
  if (!(Y_z > kMinDepthRatio)) return false;
  const double inv = 1.0 / Y_z;
  const Rows u = both((R[0] * x + R[1] * y + R[2] * z + idepth * t[0]) * inv);
  const Rows v = both((R[3] * x + R[4] * y + R[5] * z + idepth * t[1]) * inv);
  const Rows s = both(idepth * inv);
  const Rows f0 = o.f[0], f1 = o.f[1], projected = f0 * u + f1 * v;
  d->r = projected + o.f[2];
  d->J[0] = twice(s) * quad(f0, f1);
  d->J[1] = quad(-s * projected, -v * projected - f1);
  d->J[2] = quad(u * projected + f0, u * f1 - v * f0);
  d->J_idepth = (f0 * both(t[0]) + f1 * both(t[1]) - projected * both(t[2])) * both(inv);

  const Rows rr = d->r * d->r;
  const double squared = rr[0] + rr[1];
  d->weight = 1;
  d->cost = 0.5 * squared;
  if (squared > huber_width * huber_width) {
    const double norm = std::sqrt(squared);
    d->weight = huber_width / norm;
    d->cost = huber_width * (norm - 0.5 * huber_width);
  }
  return true;
}

inline void add_to_pair(const Derivatives& d, PairSums* sums) {
  const Quad w = twice(both(d.weight)), w_r = twice(both(d.weight) * d.r);
  int entry = 0;
  for (int k = 0; k < 3; ++k) {
    sums->b[k] += w_r * d.J[k];
    const Quad w_J = w * d.J[k];
    const Quad first = __builtin_shufflevector(w_J, w_J, 0, 1, 0, 1);
    const Quad second = __builtin_shufflevector(w_J, w_J, 2, 3, 2, 3);
    for (int j = k; j < 3; ++j) sums->H[entry++] += first * d.J[j];
    for (int j = k; j < 3; ++j) sums->H[entry++] += second * d.J[j];
  }
}

Matrix6d matrix_of(const PairSums& pair) {
  Matrix6d M;
  int entry = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i / 2 * 2; j < 6; ++j) {
      const Quad& sums = pair.H[entry + j / 2 - i / 2];
      if (j >= i) M(i, j) = M(j, i) = sums[2 * (j % 2)] + sums[2 * (j % 2) + 1];
      if (j == 5) entry += 3 - i / 2;
    }
  return M;
}

Vector6d vector_of(const PairSums& pair) {
  Vector6d b;
  for (int i = 0; i < 6; ++i) b[i] = pair.b[i / 2][2 * (i % 2)] + pair.b[i / 2][2 * (i % 2) + 1];
  return b;
}

// Elements of a block, row by row.
const double* elements(const SchurBlock& block) { return reinterpret_cast<const double*>(block.quad); }

// sum += A M for 6x6 matrices row by row. Even and odd terms are added apart, from the last one on, as Eigen
// does for a product of such matrices, A^T B.
EDGEVO_WIDE_CLONES void add_product(const double* A, const double* M, double* sum) {
  Quad left[6];
  Rows right[6];
  for (int k = 0; k < 6; ++k) {
    std::memcpy(&left[k], M + 6 * k, sizeof(Quad));
    std::memcpy(&right[k], M + 6 * k + 4, sizeof(Rows));
  }
  for (int i = 0; i < 6; ++i) {
    const double* a = A + 6 * i;
    Quad low;
    Rows high;
    std::memcpy(&low, sum + 6 * i, sizeof(Quad));
    std::memcpy(&high, sum + 6 * i + 4, sizeof(Rows));
    low += (a[0] * left[0] + (a[2] * left[2] + a[4] * left[4])) +
           (a[1] * left[1] + (a[3] * left[3] + a[5] * left[5]));
    high += (a[0] * right[0] + (a[2] * right[2] + a[4] * right[4])) +
            (a[1] * right[1] + (a[3] * right[3] + a[5] * right[5]));
    std::memcpy(sum + 6 * i, &low, sizeof(Quad));
    std::memcpy(sum + 6 * i + 4, &high, sizeof(Rows));
  }
}

// Sums over the observations of one point.
struct PointSums {
  double cost = 0;
  Rows depth{};  // sum w (dr/drho)^2, sum w r dr/drho
};

// Adds the observations of a point to those of their pairs; `coupling` receives one entry for each. Without
// `kAll` only the sums of the point are computed. `relative` and `pairs`: by target.
template <bool kAll>
EDGEVO_WIDE_CLONES PointSums sum_point(const PackedPoint& point, const PackedObservation* observations,
                                       const RelativePose* relative, double idepth, double huber_width,
                                       PairSums* pairs, PackedVector6* coupling) {
  PointSums sum;
  for (int k = point.begin; k < point.end; ++k) {
    const PackedObservation& o = observations[k];
    Derivatives d;
    if (!differentiate(relative[o.target], point, idepth, o, huber_width, &d)) {
      sum.cost += huber_cost(o.hidden_residual, huber_width);
      if (kAll) coupling[k] = PackedVector6{};
      continue;
    }
    sum.cost += d.cost;
    const Rows w_idepth = both(d.weight) * d.J_idepth;
    sum.depth += sums(w_idepth * d.J_idepth, w_idepth * d.r);
    if (!kAll) continue;
    for (int i = 0; i < 3; ++i) {
      const Quad products = twice(w_idepth) * d.J[i];
      coupling[k].x[i] = Rows{products[0], products[2]} + Rows{products[1], products[3]};
    }
    add_to_pair(d, &pairs[o.target]);
  }
  return sum;
}

// Adds what is known of the depth of a point apart from its observations.
void add_known_depth(const PackedPoint& point, double idepth, double huber_width, PointSums* sum) {
  const double off = idepth - point.known_idepth, sigmas = std::abs(off) * std::sqrt(point.known_information);
  const double information =
      sigmas > huber_width ? point.known_information * huber_width / sigmas : point.known_information;
  sum->cost += huber_cost(sigmas, huber_width);
  sum->depth += Rows{information, information * off};
}

}  // namespace

NormalEquationsBuilder::NormalEquationsBuilder(const PackedProblem& packed, double huber_width)
    : packed_(packed),
      huber_width_(huber_width),
      n_(packed.pose_count),
      relative_(n_ * n_),
      pairs_(n_ * n_),
      schur_(n_ * n_),
      schur_b_(n_),
      row_major_adjoint_(n_) {}

void NormalEquationsBuilder::reset_sums(NormalEquations* out) {
  out->cost = 0;
  out->idepth_information.resize(packed_.points.size());
  out->idepth_gradient.resize(packed_.points.size());
}

// Calls `use` with each pair in use and its T_target_host.
template <class Use>
void NormalEquationsBuilder::for_each_pair(const State& state, const Use& use) {
  for (int h = 0; h < n_; ++h) {
    const SE3 T_world_host = state.poses[h].inverse();
    for (int t = packed_.targets[h].first; t <= packed_.targets[h].last; ++t)
      use(h * n_ + t, state.poses[t] * T_world_host);
  }
}

void NormalEquationsBuilder::reset(const State& state, NormalEquations* out) {
  reset_sums(out);
  out->adjoint.resize(n_ * n_);
  for_each_pair(state, [&](int pair, const SE3& T_target_host) {
    relative_[pair] = relative_pose(T_target_host);
    out->adjoint[pair] = T_target_host.adjoint();
    pairs_[pair] = PairSums{};
  });
  out->H.setZero(6 * n_, 6 * n_);
  out->S.setZero(6 * n_, 6 * n_);
  out->b.setZero(6 * n_);
  out->s.setZero(6 * n_);
  out->coupling.resize(packed_.observations.size());
}

void NormalEquationsBuilder::build(const State& state, NormalEquations* out) {
  reset(state, out);
  for (int h = 0; h < n_; ++h) {
    const auto [first, last] = packed_.targets[h];
    for (int row = first; row <= last; ++row) {
      schur_b_[row] = PackedVector6{};
      std::fill(&schur_[row * n_ + first], &schur_[row * n_ + last] + 1, SchurBlock{});
    }
    for (int i = packed_.host_begin[h]; i < packed_.host_begin[h + 1]; ++i) {
      const PackedPoint& point = packed_.points[i];
      add_point<true>(point, h, i, state.idepth[point.index], out);
      if (!point.fixed && out->idepth_information[i] > kMinIdepthInformation) eliminate(point, i, out);
    }
    scatter_pairs(h, out);
    scatter_schur(h, out);
  }
}

void NormalEquationsBuilder::build_cost_and_depths(const State& state, NormalEquations* out) {
  reset_sums(out);
  for_each_pair(state, [&](int pair, const SE3& T) { relative_[pair] = relative_pose(T); });
  for (int h = 0; h < n_; ++h)
    for (int i = packed_.host_begin[h]; i < packed_.host_begin[h + 1]; ++i)
      add_point<false>(packed_.points[i], h, i, state.idepth[packed_.points[i].index], out);
}

template <bool kAll>
void NormalEquationsBuilder::add_point(const PackedPoint& point, int host, int point_index, double idepth,
                                       NormalEquations* out) {
  PointSums sum = sum_point<kAll>(point, packed_.observations.data(), &relative_[host * n_], idepth,
                                  huber_width_, &pairs_[host * n_], out->coupling.data());
  if (point.known_information > 0) add_known_depth(point, idepth, huber_width_, &sum);
  out->cost += sum.cost;
  out->idepth_information[point_index] = sum.depth[0];
  out->idepth_gradient[point_index] = sum.depth[1];
}

// The quads of a row-major outer product q e^T are products of four numbers of q, repeated, by four of e.
struct RepeatedRows {
  Quad quad[9];
};
struct RepeatedColumns {
  Quad quad[3];
};

inline RepeatedRows repeat_rows(const PackedVector6& q, double factor) {
  double v[6];
  std::memcpy(v, &q, sizeof(v));
  for (double& x : v) x *= factor;
  return {{Quad{v[0], v[0], v[0], v[0]}, Quad{v[0], v[0], v[1], v[1]}, Quad{v[1], v[1], v[1], v[1]},
           Quad{v[2], v[2], v[2], v[2]}, Quad{v[2], v[2], v[3], v[3]}, Quad{v[3], v[3], v[3], v[3]},
           Quad{v[4], v[4], v[4], v[4]}, Quad{v[4], v[4], v[5], v[5]}, Quad{v[5], v[5], v[5], v[5]}}};
}

inline RepeatedColumns repeat_columns(const PackedVector6& e) {
  Quad first, last;
  std::memcpy(&first, &e.x[0], sizeof(Quad));
  std::memcpy(&last, &e.x[1], sizeof(Quad));
  return {{first, __builtin_shufflevector(e.x[2], e.x[0], 0, 1, 2, 3), last}};
}

// M(target i, target j) += inverse e_i e_j^T for the couplings e of one point. Targets ascend, so blocks on
// and below the diagonal are filled; two matches in one target also meet crosswise.
EDGEVO_WIDE_CLONES void add_outer_products(const PackedVector6* coupling,
                                           const PackedObservation* observations, int count, double inverse,
                                           int n, SchurBlock* schur) {
  for (int i = 0; i < count; ++i) {
    const int row = observations[i].target;
    SchurBlock* const blocks = schur + std::ptrdiff_t(row) * n;
    const RepeatedRows rows = repeat_rows(coupling[i], inverse);
    for (int j = 0; j < count && observations[j].target <= row; ++j) {
      const RepeatedColumns columns = repeat_columns(coupling[j]);
      Quad* block = blocks[observations[j].target].quad;
      for (int m = 0; m < 9; ++m) block[m] += rows.quad[m] * columns.quad[m % 3];
    }
  }
}

void NormalEquationsBuilder::eliminate(const PackedPoint& point, int point_index, NormalEquations* out) {
  const double inverse = 1.0 / out->idepth_information[point_index];
  const double step = out->idepth_gradient[point_index] * inverse;
  const int count = point.end - point.begin;
  for (int i = point.begin; i < point.end; ++i)
    add_scaled(step, out->coupling[i], &schur_b_[packed_.observations[i].target]);
  add_outer_products(&out->coupling[point.begin], &packed_.observations[point.begin], count, inverse, n_,
                     schur_.data());
}

void NormalEquationsBuilder::scatter_pairs(int host, NormalEquations* out) {
  const int h = 6 * host;
  for (int target = packed_.targets[host].first; target <= packed_.targets[host].last; ++target) {
    if (target == host) continue;
    const int t = 6 * target;
    const PairSums& pair = pairs_[host * n_ + target];
    const Matrix6d& Ad = out->adjoint[host * n_ + target];
    const Matrix6d A = matrix_of(pair);
    const Matrix6d A_Ad = A * Ad;
    const Vector6d b = vector_of(pair);
    out->H.block<6, 6>(t, t) += A;
    out->H.block<6, 6>(t, h) -= A_Ad;
    out->H.block<6, 6>(h, t) -= A_Ad.transpose();
    out->H.block<6, 6>(h, h) += Ad.transpose() * A_Ad;
    out->b.segment<6>(t) += b;
    out->b.segment<6>(h) -= Ad.transpose() * b;
  }
}

// Sum over the targets `row` of Ad_row^T M(row, col). Blocks above the diagonal are those below it,
// transposed: (Ad^T M^T)^T = M Ad.
Matrix6d NormalEquationsBuilder::schur_with_host(int host, int col, const Matrix6d* Ad) const {
  const auto [first, last] = packed_.targets[host];
  RowMajor6d transposed = RowMajor6d::Zero();
  for (int row = first; row < col; ++row)
    if (row != host)
      add_product(elements(schur_[col * n_ + row]), row_major_adjoint_[row].data(), transposed.data());
  RowMajor6d sum = transposed.transpose();
  // By columns, Ad is Ad^T by rows.
  for (int row = col; row <= last; ++row)
    if (row != host) add_product(Ad[row].data(), elements(schur_[row * n_ + col]), sum.data());
  return sum;
}

void NormalEquationsBuilder::scatter_schur(int host, NormalEquations* out) {
  const int h = 6 * host;
  const Matrix6d* Ad = &out->adjoint[host * n_];
  const auto [first, last] = packed_.targets[host];
  for (int target = first; target <= last; ++target) row_major_adjoint_[target] = Ad[target];
  for (int col = first; col <= last; ++col) {
    if (col == host) continue;
    for (int row = first; row < col; ++row)
      if (row != host)
        out->S.block<6, 6>(6 * row, 6 * col) += Eigen::Map<const Matrix6d>(elements(schur_[col * n_ + row]));
    for (int row = col; row <= last; ++row)
      if (row != host)
        out->S.block<6, 6>(6 * row, 6 * col) +=
            Eigen::Map<const RowMajor6d>(elements(schur_[row * n_ + col]));
    const Matrix6d with_host = schur_with_host(host, col, Ad);
    out->S.block<6, 6>(h, 6 * col) -= with_host;
    out->S.block<6, 6>(6 * col, h) -= with_host.transpose();
    out->S.block<6, 6>(h, h) += with_host * Ad[col];
    const Vector6d b = to_vector(schur_b_[col]);
    out->s.segment<6>(6 * col) += b;
    out->s.segment<6>(h) -= Ad[col].transpose() * b;
  }
}

}  // namespace edgevo::ba
