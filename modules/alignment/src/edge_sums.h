#pragma once
// Sums of one Gauss-Newton step of edge alignment over all matched points, four points at a time.
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Points that have found their edge, number by number: what the sums read stands side by side.
class MatchedEdges {
 public:
  static constexpr int kLanes = 4;  ///< doubles of a register of AVX2
  enum Number { kX, kY, kInverseZ, kIdepth, kSigma, kNormalX, kNormalY, kResidual, kWeight, kCost, kNumbers };

  void reserve(size_t points);
  void clear() { size_ = 0; }
  int size() const { return int(size_); }

  /// `Y`: the point in the current camera, times its inverse depth in the reference; `normal` and `residual`
  /// in pixels of the match, Eq. (edgeerror); `weight` and `cost`: what the robust loss makes of the
  /// residual. At most as many points as reserved.
  void append(const Eigen::Vector3d& Y, double idepth, double idepth_sigma, const Eigen::Vector2d& normal,
              double residual, double weight, double cost) {
    const double iz = 1.0 / Y.z();
    const double numbers[kNumbers] = {Y.x() * iz, Y.y() * iz, iz,       idepth, idepth_sigma,
                                      normal.x(), normal.y(), residual, weight, cost};
    double* to = &memory_[size_ / kLanes * (kLanes * kNumbers) + size_ % kLanes];
    for (int k = 0; k < kNumbers; ++k) to[k * kLanes] = numbers[k];
    ++size_;
  }

  /// Four points: kNumbers times kLanes numbers.
  const double* block(int i) const { return memory_.data() + size_t(i) * kLanes * kNumbers; }

 private:
  size_t size_ = 0;
  std::vector<double> memory_;
};

struct EdgeSums {
  double H[21] = {};  ///< upper triangle of sum w J^T J, row by row
  double b[6] = {};   ///< sum w J^T r
  double cost = 0;    ///< robust, of all points
  double square = 0;  ///< sum of squared residuals

  void add_to(Matrix6d* H_out, Vector6d* b_out) const;
};

/// J and w of Eq. (edgeerror) at translation `t` of the current camera. A point is believed as far as its
/// depth is known: `miss_cost` bounds the cost of the rest.
EdgeSums sum_edges(const MatchedEdges& edges, const Pinhole& camera, const Eigen::Vector3d& t,
                   double miss_cost);

}  // namespace edgevo
