#pragma once
// Camera tracking: one frame against a reference cloud, with covariance and verdict.
#include <string>
#include <vector>

#include "edgevo/alignment/pose_choice.h"
#include "edgevo/core/tracking_state.h"

namespace edgevo {

/// A pose with all that is told about it.
struct TrackResult : PoseCandidate {
  TrackingState verdict =
      TrackingState::kLost;                ///< kTracking, kDegraded or kLost: T_cur_ref is then meaningless
  Matrix6d covariance = Matrix6d::Zero();  ///< of xi in T_cur_ref <- exp(xi) T_cur_ref, see pose_covariance.h
  std::vector<Vector6d>
      weak_directions;  ///< unit tangents (translation in median depths) that are poorly observed
  std::string reason;   ///< why the frame is degraded or lost, a short sentence; else empty
};

/// Covariance and verdict of a pose that `cloud` was aligned to. Cost: one pass over the cloud.
TrackResult assess(const FramePyramid& current, const ReferenceCloud& cloud, const PoseCandidate& pose,
                   const AlignmentParams& params);

/// Tries the starts in turn until one fits, then rotations around the first (rotation_search.h).
Proposer propose_starts(std::vector<SE3> starts, const PoseJudge& judge);
/// search_rotation() around `T_predicted`, if no pose fits by then. Keeps references to all but
/// `T_predicted`.
Proposer propose_rotations(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_predicted,
                           const PoseJudge& judge);

/// These two, judged by the image alone. `starts` is not empty; the first is the constant-velocity
/// prediction.
TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const AlignmentParams& params);

/// Starts for the next frame from the last two poses: constant velocity, rest, half and double velocity,
/// rotation only.
std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before);

}  // namespace edgevo
