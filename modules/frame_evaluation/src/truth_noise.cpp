// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/frame_evaluation/truth_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr size_t kMinSamples = 8;
// Standard deviation of 1 -3 3 -1 applied to white noise.
const double kThirdDifference = std::sqrt(20.0);
constexpr double kMedianOfNormal = 0.6745;  // median of the absolute value of a standard normal

// Standard deviation per axis of white noise in a sequence whose first differences are `steps`.
double noise_of(const std::vector<Eigen::Vector3d>& steps) {
  std::vector<double> magnitudes;
  for (size_t i = 2; i < steps.size(); ++i) {
    const Eigen::Vector3d third = steps[i] - 2 * steps[i - 1] + steps[i - 2];
    for (int axis = 0; axis < 3; ++axis) magnitudes.push_back(std::abs(third[axis]));
  }
  return median(std::move(magnitudes)) / kMedianOfNormal / kThirdDifference;
}

}  // namespace

TruthNoise truth_noise(const Trajectory& truth) {
  if (truth.poses.size() < kMinSamples) return {};
  std::vector<Eigen::Vector3d> moves, turns;
  for (size_t i = 1; i < truth.poses.size(); ++i) {
    const SE3 &a = truth.poses[i - 1].T_world_cam, &b = truth.poses[i].T_world_cam;
    moves.push_back(b.translation() - a.translation());
    const SE3 turn(b.rotation() * a.rotation().inverse(), Eigen::Vector3d::Zero());
    turns.push_back(turn.log().tail<3>());
  }
  return {noise_of(moves), noise_of(turns)};
}

TruthNoise larger_noise(const TruthNoise& a, const TruthNoise& b) {
  return {std::max(a.position_m, b.position_m), std::max(a.rotation_rad, b.rotation_rad)};
}

}  // namespace edgevo
