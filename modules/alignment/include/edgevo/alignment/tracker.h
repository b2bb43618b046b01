// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Camera tracking: the pose of one frame against a reference cloud, and how well it is measured.
#include <vector>

#include "edgevo/alignment/correlated_residual.h"
#include "edgevo/alignment/image_zoom.h"
#include "edgevo/alignment/pose_choice.h"

namespace edgevo {

/// Tracked pose of a frame with its covariance. Whether it is to be trusted is not decided here.
struct TrackResult : PoseCandidate {
  /// Covariance of xi in T_cur_ref <- exp(xi) T_cur_ref (pose_covariance.h); zero if the pose is not finite.
  Matrix6d covariance = Matrix6d::Zero();
  /// The error that neighbouring edges share (correlated_residual.h), not in `covariance`.
  CorrelatedResidual smooth;
  /// Its variance, px^2: that of this frame alone, until a mean of several is set.
  double correlated_px2 = 0;
  /// What the image is larger by than pose and map explain.
  ImageZoom zoom;
  /// Principal directions of the covariance, one per column: unit tangents [v, w], translation in median
  /// depths of the cloud.
  Matrix6d directions = Matrix6d::Identity();
  /// Standard deviations along `directions`, ascending: translation in median depths, rotation in radians.
  Vector6d sigmas = Vector6d::Zero();
};

/// Covariance of an aligned pose and its principal directions. Cost: about 0.1 ms for 1500 points.
TrackResult assess(const FramePyramid& current, const ReferenceCloud& cloud, const PoseCandidate& pose,
                   const AlignmentParams& params);

/// Proposes the starts one after the other until one fits, with a prior on the rotation if there is one.
Proposer propose_starts(std::vector<SE3> starts, const PoseScorer& scorer,
                        const std::optional<RotationPrior>& turn = std::nullopt);
/// Proposes rotations around `T_predicted` (rotation_search.h) if no pose fits so far. Keeps references to
/// all arguments but `T_predicted`.
Proposer propose_rotations(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_predicted,
                           const PoseScorer& scorer);

/// Tracks a frame with propose_starts() and propose_rotations(). `starts` is not empty; its first element is
/// the constant-velocity prediction.
TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const PoseScorer& scorer, const AlignmentParams& params);

/// Start poses for the next frame from the last two poses: constant velocity, no motion, half velocity,
/// double velocity, rotation only.
std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before);

}  // namespace edgevo
