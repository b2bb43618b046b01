#include "edgevo/bundle_adjustment/gauge.h"

#include <algorithm>

namespace edgevo::ba {
namespace {

// Standard deviation of the length, a share of it: far less than matches tell, far more than rounding does.
constexpr double kHeldShare = 1e-4;
// Of the way, in the map's unit, whose scenes are some ten away: keeps a way of no length from a division by
// zero.
constexpr double kLeastLength = 1e-9;

}  // namespace

BaPrior hold_baseline(const SE3& T_first_world, const SE3& T_last_world, int last_id) {
  const Eigen::Vector3d way = (T_last_world * T_first_world.inverse()).translation();
  const double sigma = kHeldShare * std::max(way.norm(), kLeastLength);
  BaPrior prior;
  prior.pose_ids = {last_id};
  prior.linearization = {T_last_world};
  prior.H = Eigen::MatrixXd::Zero(6, 6);
  prior.H.topLeftCorner<3, 3>() = way.normalized() * way.normalized().transpose() / (sigma * sigma);
  prior.b = Eigen::VectorXd::Zero(6);
  return prior;
}

}  // namespace edgevo::ba
