// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <deque>
#include <optional>

namespace edgevo {

/// The camera's translation per frame, in its own axes, over the recent frames.
class MedianMotion {
 public:
  /// Median step and its spread.
  struct Step {
    /// Median of the last kSteps frames, tangent (v of core/se3.h), in the unit of the map.
    Eigen::Vector3d translation;
    /// Standard deviation of single frames from the median, axis by axis.
    Eigen::Vector3d sigma;
  };

  /// The median step; nothing until kSteps frames in a row and kFrames in all have been seen.
  std::optional<Step> median_step() const;

  /// Adds a frame's translation. `held`: the median step itself decided on it, so that it carries no
  /// information on how evenly the camera moves.
  void follow(const Eigen::Vector3d& translation, bool held);
  /// Records frames without a pose: the next frame does not follow the last one.
  void interrupt() { steps_.clear(); }

 private:
  /// Frames of the median: four bad ones in a row leave it unchanged.
  static constexpr size_t kSteps = 9;
  /// Frames that standard deviations are averaged over: enough to know one to a sixth.
  static constexpr int kFrames = 20;

  Eigen::Vector3d median() const;

  std::deque<Eigen::Vector3d> steps_;
  Eigen::Vector3d square_ = Eigen::Vector3d::Zero();  // mean square deviation from the median, axis by axis
  int seen_ = 0;
};

}  // namespace edgevo
