#pragma once
// Camera tracking: one frame against a reference cloud, with covariance and verdict.
#include <string>
#include <vector>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/pose_evidence.h"
#include "edgevo/core/tracking_state.h"

namespace edgevo {

struct TrackResult {
  TrackingState verdict = TrackingState::kLost;  ///< kTracking, kDegraded or kLost
  SE3 T_cur_ref;                                 ///< meaningless when lost
  Matrix6d covariance = Matrix6d::Zero();        ///< of xi in T_cur_ref <- exp(xi) T_cur_ref, see pose_covariance.h
  AlignmentStats stats;
  PoseEvidence evidence;
  int starts_tried = 0;                          ///< 1: the constant-velocity start was good
  std::vector<Vector6d> weak_directions;         ///< unit tangents (translation in median depths) that are poorly observed
  std::string reason;                            ///< why the frame is degraded or lost, a short sentence; else empty
};

/// Tries the starts in turn until one gives a good alignment, else keeps the one with the largest inlier share.
/// `starts` is not empty; the first is the constant-velocity prediction.
TrackResult track(const FramePyramid& current, const ReferenceCloud& cloud, const std::vector<SE3>& starts,
                  const AlignmentParams& params);

/// As track, from a pose that is nearly right: the finest edges alone, for a cloud whose points have moved a little. Cost: a third.
TrackResult track_again(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref, const AlignmentParams& params);

/// As track, near a place that is known: the edges alone, with a prior on the translation. Evidence and covariance are those of the image.
/// Cost: one alignment of edges on two levels.
TrackResult track_near(const FramePyramid& current, const ReferenceCloud& cloud, const TranslationPrior& prior, const AlignmentParams& params);

/// As track, where the motion is known but for the length of its translation: rotation and direction are those of `T_cur_ref`, the length
/// is sought from half to twice that of `T_cur_ref`. Then all is left to the edges. Cost: thirteen evaluations of the edge cost and one
/// alignment of edges on two levels.
TrackResult track_along(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref, const AlignmentParams& params);

/// Starts for the next frame from the last two poses: constant velocity, rest, half and double velocity, rotation only.
std::vector<SE3> motion_hypotheses(const SE3& T_last_ref, const SE3& T_last_before);

}  // namespace edgevo
