// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The median-motion prior: how evenly the camera moves, and how well an unusual step must be supported.
//
// Where all edges of the scene run along the motion (a corridor, a tunnel), few points constrain how far the
// camera has gone, and glare and shadows, which move by themselves, can outvote them: tracking then jumps by
// the distance of several frames, at an inlier share of 0.9
// (lab 2026-11-23_motion_outliers).
#include <deque>
#include <optional>

#include "edgevo/alignment/pose_choice.h"
#include "edgevo/core/se3.h"

namespace edgevo {

class MotionModel;

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

  /// Adds a frame's translation. `held`: the prior itself decided on it, so that it carries no information on
  /// how evenly the camera moves.
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

/// Largest difference, over the camera's axes, between the translation to `T_cur_ref` since the frame before
/// and the median step, in standard deviations of single frames. NaN over a gap, and until the median step
/// and a spread are known.
double step_sigmas(const MotionModel& motion, const SE3& T_cur_ref);

/// The step that a frame is expected to make, for a camera at constant speed.
class MedianMotionPrior {
 public:
  /// The prior for the current frame; nothing at a standstill, in pure rotation, for a camera moved about by
  /// hand, and over a gap.
  static std::optional<MedianMotionPrior> of(const MotionModel& motion);

  /// Likelihood of a pose relative to the median step, 0 to 1: for SupportScorer.
  double likelihood(const SE3& T_cur_ref) const;
  /// True if the translation differs from the median step by more than the camera's steps do by chance.
  bool is_unusual(const SE3& T_cur_ref) const;
  /// True if the image can distinguish the pose from the median step. Cost: two projections per point.
  bool is_apart(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cur_ref) const;
  /// The frame near the median step, as a hypothesis.
  PoseHypothesis hypothesis() const;

 private:
  SE3 T_last_ref_, T_expected_ref_;
  MedianMotion::Step step_;
};

}  // namespace edgevo
