// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/median_motion.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "edgevo/core/order_statistics.h"

namespace edgevo {

Eigen::Vector3d MedianMotion::median() const {
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const Eigen::Vector3d& step : steps_) along.push_back(step[axis]);
    median[axis] = edgevo::median(std::move(along));
  }
  return median;
}

std::optional<MedianMotion::Step> MedianMotion::median_step() const {
  if (steps_.size() < kSteps || seen_ < kFrames) return std::nullopt;
  return Step{median(), square_.cwiseSqrt()};
}

void MedianMotion::follow(const Eigen::Vector3d& translation, bool held) {
  if (steps_.size() == kSteps && !held) {
    const Eigen::Vector3d square = (translation - median()).cwiseAbs2();
    square_ += (square - square_) / std::min(++seen_, kFrames);
  }
  steps_.push_back(translation);
  if (steps_.size() > kSteps) steps_.pop_front();
}

}  // namespace edgevo
