#include "bundle_adjustment_normal_equations.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/robust.h"

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

}  // namespace

// One observation: residual and derivatives of its two rows, and what the loss makes of them.
struct NormalEquationsBuilder::Derivatives {
  Rows r;
  Rows J[6];  // by the target pose
  Rows J_idepth;
  double weight;
  double cost;
};

Matrix6d NormalEquationsBuilder::to_matrix(const PairSums& pair) {
  Matrix6d M;
  int k = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j, ++k) M(i, j) = M(j, i) = pair.H[k][0] + pair.H[k][1];
  return M;
}

Matrix6d NormalEquationsBuilder::to_matrix(const SchurBlock& block) {
  Matrix6d M;
  for (int i = 0; i < 6; ++i) M.row(i) = to_vector(block.row[i]);
  return M;
}

NormalEquationsBuilder::NormalEquationsBuilder(const Window& window, double huber_width)
    : window_(window),
      huber_width_(huber_width),
      n_(window.pose_count),
      relative_(n_ * n_),
      pairs_(n_ * n_),
      schur_(n_ * n_),
      schur_b_(n_) {}

void NormalEquationsBuilder::reset(const State& state, NormalEquations* out) {
  out->adjoint.resize(n_ * n_);
  for (int h = 0; h < n_; ++h)
    for (int t = 0; t < n_; ++t) {
      const int pair = h * n_ + t;
      relative_[pair] = relative_pose(state.poses[t], state.poses[h]);
      out->adjoint[pair] = (state.poses[t] * state.poses[h].inverse()).adjoint();
      pairs_[pair] = PairSums{};
    }
  out->cost = 0;
  out->H.setZero(6 * n_, 6 * n_);
  out->S.setZero(6 * n_, 6 * n_);
  out->b.setZero(6 * n_);
  out->s.setZero(6 * n_);
  out->idepth_information.resize(window_.points.size());
  out->idepth_gradient.resize(window_.points.size());
  out->coupling.resize(window_.observations.size());
}

void NormalEquationsBuilder::build(const State& state, NormalEquations* out) {
  reset(state, out);
  for (int h = 0; h < n_; ++h) {
    find_targets(h);
    for (int row = first_target_; row <= last_target_; ++row) {
      schur_b_[row] = PackedVector6{};
      std::fill(&schur_[row * n_ + first_target_], &schur_[row * n_ + last_target_] + 1, SchurBlock{});
    }
    for (int i = window_.host_begin[h]; i < window_.host_begin[h + 1]; ++i) {
      const WindowPoint& point = window_.points[i];
      add_point(point, h, i, state.idepth[point.index], out);
      if (!point.fixed && out->idepth_information[i] > kMinIdepthInformation) eliminate(point, i, out);
    }
    scatter_pairs(h, out);
    scatter_schur(h, out);
  }
}

// A host's points are seen by keyframes near it only: a long problem is a band.
void NormalEquationsBuilder::find_targets(int host) {
  first_target_ = n_, last_target_ = -1;
  for (int i = window_.host_begin[host]; i < window_.host_begin[host + 1]; ++i)
    for (int k = window_.points[i].begin; k < window_.points[i].end; ++k) {
      first_target_ = std::min(first_target_, window_.observations[k].target);
      last_target_ = std::max(last_target_, window_.observations[k].target);
    }
}

// J_target = [s g | p x g] with g = (f0, f1, -f0 u - f1 v), p = (u, v, 1) = Y / Y_z, s = rho / Y_z;  J_idepth
// = g . t / Y_z.
inline bool NormalEquationsBuilder::differentiate(const RelativePose& T, const WindowPoint& point,
                                                  double idepth, const WindowObservation& o,
                                                  Derivatives* d) const {
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
  d->J[0] = s * f0;
  d->J[1] = s * f1;
  d->J[2] = -s * projected;
  d->J[3] = -v * projected - f1;
  d->J[4] = u * projected + f0;
  d->J[5] = u * f1 - v * f0;
  d->J_idepth = (f0 * both(t[0]) + f1 * both(t[1]) - projected * both(t[2])) * both(inv);

  const Rows rr = d->r * d->r;
  const double squared = rr[0] + rr[1];
  d->weight = 1;
  d->cost = 0.5 * squared;
  if (squared > huber_width_ * huber_width_) {
    const double norm = std::sqrt(squared);
    d->weight = huber_width_ / norm;
    d->cost = huber_width_ * (norm - 0.5 * huber_width_);
  }
  return true;
}

inline void NormalEquationsBuilder::add_to_pair(const Derivatives& d, PairSums* sums) {
  const Rows w = both(d.weight), w_r = w * d.r;
  int entry = 0;
  for (int i = 0; i < 6; ++i) {
    sums->b[i] += w_r * d.J[i];
    const Rows w_J = w * d.J[i];
    for (int j = i; j < 6; ++j, ++entry) sums->H[entry] += w_J * d.J[j];
  }
}

void NormalEquationsBuilder::add_point(const WindowPoint& point, int host, int point_index, double idepth,
                                       NormalEquations* out) {
  const RelativePose* relative = &relative_[host * n_];
  PairSums* pairs = &pairs_[host * n_];
  PackedVector6* coupling = out->coupling.data();
  Rows depth = both(0);  // information, gradient
  double cost = 0;
  for (int k = point.begin; k < point.end; ++k) {
    const WindowObservation& o = window_.observations[k];
    Derivatives d;
    if (!differentiate(relative[o.target], point, idepth, o, &d)) {
      cost += huber_cost(o.hidden_residual, huber_width_);
      coupling[k] = PackedVector6{};
      continue;
    }
    cost += d.cost;
    const Rows w_idepth = both(d.weight) * d.J_idepth;
    depth += sums(w_idepth * d.J_idepth, w_idepth * d.r);
    for (int i = 0; i < 3; ++i) coupling[k].x[i] = sums(w_idepth * d.J[2 * i], w_idepth * d.J[2 * i + 1]);
    add_to_pair(d, &pairs[o.target]);
  }
  out->cost += cost;
  out->idepth_information[point_index] = depth[0];
  out->idepth_gradient[point_index] = depth[1];
}

void NormalEquationsBuilder::eliminate(const WindowPoint& point, int point_index, NormalEquations* out) {
  const double inv = 1.0 / out->idepth_information[point_index];
  const double step = out->idepth_gradient[point_index] * inv;
  const WindowObservation* observations = window_.observations.data();
  for (int i = point.begin; i < point.end; ++i) {
    const int row = observations[i].target;
    const PackedVector6 e_row = out->coupling[i];
    add_scaled(step, e_row, &schur_b_[row]);
    PackedVector6 q{};
    add_scaled(inv, e_row, &q);
    // Targets ascend, so blocks on and below the diagonal are filled; two matches in one target also meet
    // crosswise.
    for (int j = point.begin; j < point.end && observations[j].target <= row; ++j) {
      const PackedVector6 e = out->coupling[j];
      SchurBlock& block = schur_[row * n_ + observations[j].target];
      for (int k = 0; k < 6; ++k) add_scaled(q.x[k / 2][k % 2], e, &block.row[k]);
    }
  }
}

void NormalEquationsBuilder::scatter_pairs(int host, NormalEquations* out) {
  const int h = 6 * host;
  for (int target = first_target_; target <= last_target_; ++target) {
    if (target == host) continue;
    const int t = 6 * target;
    const PairSums& pair = pairs_[host * n_ + target];
    const Matrix6d& Ad = out->adjoint[host * n_ + target];
    const Matrix6d A = to_matrix(pair);
    const Matrix6d A_Ad = A * Ad;
    Vector6d b;
    for (int i = 0; i < 6; ++i) b[i] = pair.b[i][0] + pair.b[i][1];
    out->H.block<6, 6>(t, t) += A;
    out->H.block<6, 6>(t, h) -= A_Ad;
    out->H.block<6, 6>(h, t) -= A_Ad.transpose();
    out->H.block<6, 6>(h, h) += Ad.transpose() * A_Ad;
    out->b.segment<6>(t) += b;
    out->b.segment<6>(h) -= Ad.transpose() * b;
  }
}

void NormalEquationsBuilder::scatter_schur(int host, NormalEquations* out) {
  const int h = 6 * host;
  const Matrix6d* Ad = &out->adjoint[host * n_];
  for (int col = first_target_; col <= last_target_; ++col) {
    if (col == host) continue;
    Matrix6d with_host = Matrix6d::Zero();  // sum over rows of Ad_row^T M(row, col)
    for (int row = first_target_; row <= last_target_; ++row) {
      if (row == host) continue;
      const bool lower = row >= col;
      Matrix6d M = to_matrix(schur_[lower ? row * n_ + col : col * n_ + row]);
      if (!lower) M.transposeInPlace();
      out->S.block<6, 6>(6 * row, 6 * col) += M;
      with_host.noalias() += Ad[row].transpose() * M;
    }
    out->S.block<6, 6>(h, 6 * col) -= with_host;
    out->S.block<6, 6>(6 * col, h) -= with_host.transpose();
    out->S.block<6, 6>(h, h) += with_host * Ad[col];
    const Vector6d b = to_vector(schur_b_[col]);
    out->s.segment<6>(6 * col) += b;
    out->s.segment<6>(h) -= Ad[col].transpose() * b;
  }
}

}  // namespace edgevo::ba
