// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sums.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

constexpr int kLanes = MatchedEdges::kLanes;  // points at a time
// Offsets of the EdgeSums.
enum { kH = 0, kB = kH + 21, kCostSum = kB + 6, kSquare, kSums };

// The compiler's vector type, which maps to registers of the available width.
using Quad = double __attribute__((vector_size(8 * kLanes)));

struct Constants {
  double fx, fy, tx, ty, tz, miss_cost;
};

// Sums over whole blocks of points, lane by lane.
EDGEVO_WIDE_CLONES void sum_blocks(const double* block, int count, const Constants& c, double* out) {
  using M = MatchedEdges;
  Quad sums[kSums];
  for (Quad& sum : sums) sum = Quad{};
  for (; count > 0; --count, block += M::kNumbers * kLanes) {
    Quad n[M::kNumbers];
    std::memcpy(n, block, sizeof(n));
    const Quad x = n[M::kX], y = n[M::kY], r = n[M::kResidual], a = n[M::kIdepth] * n[M::kInverseZ];
    const Quad gx = c.fx * n[M::kNormalX], gy = c.fy * n[M::kNormalY],
               g = gx * x + gy * y;  // g^T J_pi Y_z = (gx, gy, -g)
    const Quad J[6] = {a * gx, a * gy, -(a * g), -(y * g + gy), x * g + gx, x * gy - y * gx};
    // depth_weight() of edge_match.h: 1 / (1 + s^2), s the standard deviation along the normal, pixels.
    const Quad s = (gx * c.tx + gy * c.ty - g * c.tz) * n[M::kInverseZ] * n[M::kSigma];
    const Quad w_depth = 1.0 / (1.0 + s * s), w = w_depth * n[M::kWeight];
    int k = kH;
    for (int i = 0; i < 6; ++i) {
      const Quad w_J = w * J[i];
      for (int j = i; j < 6; ++j) sums[k++] += w_J * J[j];
    }
    const Quad w_r = w * r;
    for (int i = 0; i < 6; ++i) sums[kB + i] += w_r * J[i];
    const Quad cost = n[M::kCost], most = Quad{} + c.miss_cost, bounded = cost < most ? cost : most;
    sums[kCostSum] += w_depth * cost + (1.0 - w_depth) * bounded;
    sums[kSquare] += r * r;
  }
  std::memcpy(out, sums, sizeof(sums));
}

}  // namespace

void MatchedEdges::reserve(size_t points) {
  memory_.resize((points + kLanes - 1) / kLanes * kLanes * kNumbers);
}

void EdgeSums::add_to(Matrix6d* H_out, Vector6d* b_out) const {
  int k = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j, ++k) {
      (*H_out)(i, j) += H[k];
      if (j > i) (*H_out)(j, i) += H[k];
    }
  for (int i = 0; i < 6; ++i) (*b_out)[i] += b[i];
}

EdgeSums sum_edges(const MatchedEdges& edges, const Pinhole& camera, const Eigen::Vector3d& t,
                   double miss_cost) {
  const Constants constants{camera.fx, camera.fy, t.x(), t.y(), t.z(), miss_cost};
  constexpr int kBlock = MatchedEdges::kNumbers * kLanes;  // numbers
  const int whole = edges.size() / kLanes, rest = edges.size() % kLanes;
  std::array<double, kSums * kLanes> lanes{}, last{};
  sum_blocks(edges.block(0), whole, constants, lanes.data());
  if (rest > 0) {  // padded with zeros, which have neither weight nor cost
    std::array<double, kBlock> block{};
    for (int k = 0; k < MatchedEdges::kNumbers; ++k)
      std::copy_n(edges.block(whole) + k * kLanes, rest, &block[size_t(k) * kLanes]);
    sum_blocks(block.data(), 1, constants, last.data());
  }
  double sums[kSums];
  for (int k = 0; k < kSums; ++k) {
    sums[k] = 0;
    for (int lane = 0; lane < kLanes; ++lane)
      sums[k] += lanes[size_t(k) * kLanes + lane] + last[size_t(k) * kLanes + lane];
  }
  EdgeSums out;
  std::copy_n(sums + kH, kB - kH, out.H);
  std::copy_n(sums + kB, kCostSum - kB, out.b);
  out.cost = sums[kCostSum];
  out.square = sums[kSquare];
  return out;
}

}  // namespace edgevo
