// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Camera tracking: one frame against a reference cloud, with covariance and tracking status.
#include <string>
#include <vector>

#include "edgevo/alignment/pose_choice.h"
#include "edgevo/core/tracking_state.h"

namespace edgevo {

/// Tracked pose of a frame with its covariance and status.
struct TrackResult : PoseCandidate {
  /// kTracking, kDegraded, or kLost, which makes T_cur_ref meaningless.
  TrackingState status = TrackingState::kLost;
  /// Covariance of xi in T_cur_ref <- exp(xi) T_cur_ref (pose_covariance.h).
  Matrix6d covariance = Matrix6d::Zero();
  /// Poorly observed directions: unit tangents [v, w], translation in median depths.
  std::vector<Vector6d> weak_directions;
  /// Why the frame is degraded or lost, in a short sentence; empty for kTracking.
  std::string reason;
};

/// Covariance and tracking status of an aligned pose. Cost: about 0.1 ms for 1500 points.
TrackResult assess(const FramePyramid& current, const ReferenceCloud& cloud, const PoseCandidate& pose,
                   const AlignmentParams& params);

/// Proposes the starts in turn until one fits.
Proposer propose_starts(std::vector<SE3> starts, const PoseScorer& scorer);
/// Proposes rotations around `T_predicted` (rotation_search.h) if no pose fits so far. Keeps references to
/// all arguments but `T_predicted`.
Proposer propose_rotations(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_predicted,
                           const PoseScorer& scorer);

/// Tracks a frame with propose_starts() and propose_rotations(), scored by the image alone. `starts` is not
/// empty; its first element is the constant-velocity prediction.
TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const AlignmentParams& params);

/// Start poses for the next frame from the last two poses: constant velocity, no motion, half velocity,
/// double velocity, rotation only.
std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before);

}  // namespace edgevo
