// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sums of one Gauss-Newton step of edge alignment over all matched points, four points at a time.
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Matched points in a layout of structures of arrays, so that the sums read contiguous memory.
class MatchedEdges {
 public:
  /// Doubles per AVX2 register.
  static constexpr int kLanes = 4;
  enum Number { kX, kY, kInverseZ, kIdepth, kSigma, kNormalX, kNormalY, kResidual, kWeight, kCost, kNumbers };

  void reserve(size_t points);
  void clear() { size_ = 0; }
  int size() const { return int(size_); }

  /// Adds a point. `Y`: the point in the current camera times its inverse depth in the reference. `normal`,
  /// `residual`: of the match, Eq. (edgeerror), pixels. `weight`, `cost`: robust weight and loss of the
  /// residual. Requires enough reserved points.
  void append(const Eigen::Vector3d& Y, double idepth, double idepth_sigma, const Eigen::Vector2d& normal,
              double residual, double weight, double cost) {
    const double iz = 1.0 / Y.z();
    const double numbers[kNumbers] = {Y.x() * iz, Y.y() * iz, iz,       idepth, idepth_sigma,
                                      normal.x(), normal.y(), residual, weight, cost};
    double* to = &memory_[size_ / kLanes * (kLanes * kNumbers) + size_ % kLanes];
    for (int k = 0; k < kNumbers; ++k) to[k * kLanes] = numbers[k];
    ++size_;
  }

  /// Numbers of the i-th block of four points: kNumbers times kLanes.
  const double* block(int i) const { return memory_.data() + size_t(i) * kLanes * kNumbers; }

 private:
  size_t size_ = 0;
  std::vector<double> memory_;
};

/// Sums of one Gauss-Newton step.
struct EdgeSums {
  /// Upper triangle of sum w J^T J, row by row.
  double H[21] = {};
  /// Sum of w J^T r.
  double b[6] = {};
  /// Robust cost of all points.
  double cost = 0;
  /// Sum of squared residuals.
  double square = 0;

  void add_to(Matrix6d* H_out, Vector6d* b_out) const;
};

/// Sums Eq. (edgeerror) at translation `t` of the current camera. A point with an uncertain depth weighs
/// less: `miss_cost` bounds the cost of the remaining share.
EdgeSums sum_edges(const MatchedEdges& edges, const Pinhole& camera, const Eigen::Vector3d& t,
                   double miss_cost);

}  // namespace edgevo
