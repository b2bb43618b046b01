// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The median-motion prior: how evenly the camera moves, and how well an unusual step must be supported.
//
// Where all edges of the scene run along the motion (a corridor, a tunnel), few points constrain how far the
// camera has gone, and glare and shadows, which move by themselves, can outvote them: tracking then jumps by
// the distance of several frames, at an inlier share of 0.9
// (lab 2026-11-23_motion_outliers).
#include <optional>

#include "edgevo/alignment/pose_choice.h"
#include "edgevo/core/median_motion.h"
#include "edgevo/core/se3.h"
#include "edgevo/tracking/motion_model.h"

namespace edgevo {

/// Likelihood of an unusual motion relative to the usual one: if the image shows the unusual one, the usual
/// has less than 0.82 of its support (driving, and by hand).
constexpr double kUnusualLikelihood = 0.85;

/// Largest difference, over the camera's axes, between the translation to `T_cur_ref` since the frame before
/// and the median step `usual`, in standard deviations of single frames. NaN over a gap, and until `usual`
/// and a spread are known.
double step_sigmas(const MotionModel& motion, const std::optional<MedianMotion::Step>& usual,
                   const SE3& T_cur_ref);

/// The step that a frame is expected to make, for a camera at constant speed.
class MedianMotionPrior {
 public:
  /// The prior for the current frame from the median step, if that is known; nothing at a standstill, in pure
  /// rotation, for a camera moved about by hand, and over a gap.
  static std::optional<MedianMotionPrior> of(const MotionModel& motion,
                                             const std::optional<MedianMotion::Step>& usual);

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
