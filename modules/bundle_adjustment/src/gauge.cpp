// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/bundle_adjustment/gauge.h"

#include <algorithm>

namespace edgevo::ba {
namespace {

// Standard deviation of the baseline, share of its length: far below that of the matches, far above rounding.
constexpr double kHeldShare = 1e-4;
// Shortest baseline in the unit of the map, whose depths are about ten: prevents a division by zero.
constexpr double kMinLength = 1e-9;

}  // namespace

BaPrior fix_baseline(const SE3& T_first_world, const SE3& T_last_world, int last_id) {
  const Eigen::Vector3d way = (T_last_world * T_first_world.inverse()).translation();
  const double sigma = kHeldShare * std::max(way.norm(), kMinLength);
  BaPrior prior;
  prior.pose_ids = {last_id};
  prior.linearization = {T_last_world};
  prior.H = Eigen::MatrixXd::Zero(6, 6);
  prior.H.topLeftCorner<3, 3>() = way.normalized() * way.normalized().transpose() / (sigma * sigma);
  prior.b = Eigen::VectorXd::Zero(6);
  return prior;
}

}  // namespace edgevo::ba
