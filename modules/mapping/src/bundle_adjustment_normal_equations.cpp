#include "bundle_adjustment_normal_equations.h"

#include <cmath>

#include "edgevo/core/robust.h"

namespace edgevo::ba {
namespace {

using Pack = Eigen::Array2d;

// One residual row: its value, its six derivatives by the target pose, and the one by inverse depth.
struct Row {
  double r;
  double J[6];
  double J_idepth;
};

// The row's function f . (u, v, 1), of p = (u, v, 1) = Y / Y_z; s = rho / Y_z, t the pair's translation over Y_z.
inline void evaluate_row(const double* f, double u, double v, double s, const double* t, Row* row) {
  const double projected = f[0] * u + f[1] * v;
  row->r = projected + f[2];
  row->J[0] = s * f[0];
  row->J[1] = s * f[1];
  row->J[2] = -s * projected;
  row->J[3] = -v * projected - f[1];  // p x (f0, f1, -projected)
  row->J[4] = f[0] + u * projected;
  row->J[5] = u * f[1] - v * f[0];
  row->J_idepth = f[0] * t[0] + f[1] * t[1] - projected * t[2];
}

inline Pack pack(const double* x) { return Pack(x[0], x[1]); }

Matrix6d unpack(const std::array<Pack, 12>& H) {
  Matrix6d M;
  int k = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i / 2; j < 3; ++j, ++k) M.block<1, 2>(i, 2 * j) = H[k].matrix().transpose();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < i; ++j) M(i, j) = M(j, i);
  return M;
}

Matrix6d unpack(const std::array<Pack, 18>& S) {
  Matrix6d M;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 3; ++j) M.block<1, 2>(i, 2 * j) = S[3 * i + j].matrix().transpose();
  return M;
}

}  // namespace

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
      pairs_[pair].H.fill(Pack::Zero());
      pairs_[pair].b.fill(Pack::Zero());
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
    for (SchurBlock& block : schur_) block.fill(Pack::Zero());
    for (Vector6d& b : schur_b_) b.setZero();
    for (int i = window_.host_begin[h]; i < window_.host_begin[h + 1]; ++i) {
      const WindowPoint& point = window_.points[i];
      add_point(point, h, i, state.idepth[point.index], out);
      if (!point.fixed && out->idepth_information[i] > kMinIdepthInformation) eliminate(point, i, out);
    }
    scatter_pairs(h, out);
    scatter_schur(h, out);
  }
}

void NormalEquationsBuilder::add_point(const WindowPoint& point, int host, int point_index, double idepth,
                                       NormalEquations* out) {
  const double x = point.ray[0], y = point.ray[1], z = point.ray[2];
  double information = 0, gradient = 0, cost = 0;
  for (int k = point.begin; k < point.end; ++k) {
    const WindowObservation& o = window_.observations[k];
    const int pair = host * n_ + o.target;
    const double* R = relative_[pair].R;
    const double* t = relative_[pair].t;
    const double Y_z = R[6] * x + R[7] * y + R[8] * z + idepth * t[2];
    if (!(Y_z > kMinDepthRatio)) {
      cost += huber_cost(o.hidden_residual, huber_width_);
      out->coupling[k].setZero();
      continue;
    }
    const double inv = 1.0 / Y_z;
    const double u = (R[0] * x + R[1] * y + R[2] * z + idepth * t[0]) * inv;
    const double v = (R[3] * x + R[4] * y + R[5] * z + idepth * t[1]) * inv;
    const double t_scaled[3] = {t[0] * inv, t[1] * inv, t[2] * inv};
    Row n, d;
    evaluate_row(o.normal, u, v, idepth * inv, t_scaled, &n);
    evaluate_row(o.tangent, u, v, idepth * inv, t_scaled, &d);

    const double squared = n.r * n.r + d.r * d.r;
    const double norm = std::sqrt(squared);
    const bool inlier = norm <= huber_width_;
    const double w = inlier ? 1.0 : huber_width_ / norm;
    cost += inlier ? 0.5 * squared : huber_width_ * (norm - 0.5 * huber_width_);

    const double wn = w * n.J_idepth, wd = w * d.J_idepth;
    information += wn * n.J_idepth + wd * d.J_idepth;
    gradient += wn * n.r + wd * d.r;

    const Pack Jn[3] = {pack(n.J), pack(n.J + 2), pack(n.J + 4)};
    const Pack Jd[3] = {pack(d.J), pack(d.J + 2), pack(d.J + 4)};
    PairSums& sums = pairs_[pair];
    const double rn = w * n.r, rd = w * d.r;
    for (int j = 0; j < 3; ++j) {
      sums.b[j] += rn * Jn[j] + rd * Jd[j];
      out->coupling[k].segment<2>(2 * j) = (wn * Jn[j] + wd * Jd[j]).matrix();
    }
    int entry = 0;
    for (int i = 0; i < 6; ++i) {
      const double a = w * n.J[i], c = w * d.J[i];
      for (int j = i / 2; j < 3; ++j, ++entry) sums.H[entry] += a * Jn[j] + c * Jd[j];
    }
  }
  out->cost += cost;
  out->idepth_information[point_index] = information;
  out->idepth_gradient[point_index] = gradient;
}

void NormalEquationsBuilder::eliminate(const WindowPoint& point, int point_index, NormalEquations* out) {
  const double inv = 1.0 / out->idepth_information[point_index];
  const double step = out->idepth_gradient[point_index] * inv;
  for (int i = point.begin; i < point.end; ++i) {
    const Vector6d& e_row = out->coupling[i];
    const int row = window_.observations[i].target;
    schur_b_[row] += step * e_row;
    double q[6];
    for (int k = 0; k < 6; ++k) q[k] = inv * e_row[k];
    // Targets ascend, so blocks on and below the diagonal are filled; two matches in one target also meet crosswise.
    for (int j = point.begin; j < point.end && window_.observations[j].target <= row; ++j) {
      SchurBlock& block = schur_[row * n_ + window_.observations[j].target];
      const double* e = out->coupling[j].data();
      const Pack e0 = pack(e), e1 = pack(e + 2), e2 = pack(e + 4);
      for (int k = 0; k < 6; ++k) {
        block[3 * k] += q[k] * e0;
        block[3 * k + 1] += q[k] * e1;
        block[3 * k + 2] += q[k] * e2;
      }
    }
  }
}

void NormalEquationsBuilder::scatter_pairs(int host, NormalEquations* out) {
  const int h = 6 * host;
  for (int target = 0; target < n_; ++target) {
    if (target == host) continue;
    const int t = 6 * target;
    const PairSums& sums = pairs_[host * n_ + target];
    const Matrix6d& Ad = out->adjoint[host * n_ + target];
    const Matrix6d A = unpack(sums.H);
    const Matrix6d A_Ad = A * Ad;
    Vector6d b;
    b << sums.b[0].matrix(), sums.b[1].matrix(), sums.b[2].matrix();
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
  for (int col = 0; col < n_; ++col) {
    if (col == host) continue;
    Matrix6d with_host = Matrix6d::Zero();  // sum over rows of Ad_row^T M(row, col)
    for (int row = 0; row < n_; ++row) {
      if (row == host) continue;
      const bool lower = row >= col;
      Matrix6d M = unpack(schur_[lower ? row * n_ + col : col * n_ + row]);
      if (!lower) M.transposeInPlace();
      out->S.block<6, 6>(6 * row, 6 * col) += M;
      with_host.noalias() += Ad[row].transpose() * M;
    }
    out->S.block<6, 6>(h, 6 * col) -= with_host;
    out->S.block<6, 6>(6 * col, h) -= with_host.transpose();
    out->S.block<6, 6>(h, h) += with_host * Ad[col];
    out->s.segment<6>(6 * col) += schur_b_[col];
    out->s.segment<6>(h) -= Ad[col].transpose() * schur_b_[col];
  }
}

}  // namespace edgevo::ba
