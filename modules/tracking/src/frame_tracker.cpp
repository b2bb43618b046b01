// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/frame_tracker.h"

#include <algorithm>
#include <cmath>

#include "edgevo/bundle_adjustment/epipolar_lines.h"
#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/core/stage_timer.h"
#include "edgevo/core/thread_clock.h"
#include "edgevo/core/trace.h"
#include "edgevo/tracking/median_motion_prior.h"

namespace edgevo {
namespace {

const Pinhole& pinhole_of(const TrackingTask& task) { return task.pyramid.finest().pinhole; }

// ---- proposers: the cheapest and most likely first ----

// The median step of a camera at constant speed, if the best pose so far differs from it.
Proposer propose_median_motion(const TrackingTask& task, const std::optional<MedianMotionPrior>& prior,
                               const SupportScorer& scorer) {
  return {ProposerKind::kMedianMotion,
          [&](const PoseCandidate& best) {
            return prior && !task.was_lost && !scorer.is_lost(best) && prior->is_unusual(best.T_cur_ref) &&
                   prior->is_apart(pinhole_of(task), task.reference.cloud, best.T_cur_ref);
          },
          [&] {
            std::vector<PoseHypothesis> hypotheses{prior->hypothesis()};
            hypotheses.front().turn = task.turn;
            return hypotheses;
          }};
}

// Most depths are guesses, and points that are free along their edges fit a pose, right or wrong.
bool is_guess(const TrackingTask& task) {
  return task.params.corners.max_inlier_share > 0 &&
         2 * size_t(task.reference.known_points) < task.reference.cloud.points.size();
}

// Corners are tracked when the frame is about to be lost, or has few inliers or mostly guessed depths while a
// keyframe is made at every frame: large motion. At small motion bad light causes the same, and
// misleads corners, too.
bool calls_for_corners(const TrackingTask& task, const PoseCandidate& pose, const SupportScorer& scorer) {
  const bool few_fit = pose.evidence.inlier_share < task.params.corners.max_inlier_share;
  if (task.was_lost || !(few_fit || is_guess(task))) return false;
  return scorer.is_lost(pose) || (task.keyframes.follows_keyframe() &&
                                  task.keyframes.calls_for_keyframe(pose.T_cur_ref, task.reference));
}

// A hypothesis from corners (features/corner_motion.h), searched from the predicted pose, not from the one
// that the edges found: rotation and direction from corners, the length from the edges.
std::vector<PoseHypothesis> corner_hypotheses(const TrackingTask& task, Track* track) {
  const TraceScope traced(name_of(Stage::kCorners));
  const double start = thread_cpu_ms();
  const SE3 expected = task.motion.predict();
  std::vector<PoseHypothesis> hypotheses;
  std::optional<CornerMotion> found =
      find_corner_motion(pinhole_of(task), *task.reference.cloud.pyramid, task.pyramid, expected,
                         task.params.corners, task.random);
  if (found) {
    const SE3 T_cur_ref(found->T_to_from.rotation(),
                        expected.translation().norm() * found->T_to_from.translation());
    hypotheses.push_back({T_cur_ref, PoseHypothesis::Refinement::kLengthThenEdges});
    // At large motion the corners are adjusted with the frame, whichever pose wins.
    if (task.keyframes.follows_keyframe()) {
      track->corners = std::move(found->pairs);
      track->T_by_corners = T_cur_ref;
    }
  }
  track->corner_ms = thread_cpu_ms() - start;
  return hypotheses;
}

Proposer propose_corner_motion(const TrackingTask& task, const SupportScorer& scorer, Track* track) {
  return {ProposerKind::kCorners,
          [&](const PoseCandidate& best) {
            return calls_for_corners(task, best, scorer) && (!task.corners_later || scorer.is_lost(best));
          },
          [&task, track] { return corner_hypotheses(task, track); }};
}

// Share of the corners that a pose explains.
double explained_share(const Pinhole& pinhole, const std::vector<CornerPair>& corners, const SE3& T_cur_ref) {
  constexpr double kExplainedPx = 2;  // a corner is followed to half a pixel
  const auto explained = std::count_if(corners.begin(), corners.end(), [&](const CornerPair& c) {
    const EpipolarLines lines = epipolar_lines(T_cur_ref, c.from, c.to);
    return pinhole.fx * std::abs(lines.in_to.dot(c.to)) / lines.length < kExplainedPx;
  });
  return double(explained) / double(corners.size());
}

// The pose by the edges, unless it breaks the epipolar constraint of a tenth of the corners that agree on one
// motion: a pose that is right explains all of them but some. Then the map is bent, edges follow it, and each
// frame bends it further. The rotation and direction of the corners hold, and the edges give the length.
PoseCandidate hold_to_corners(const TrackingTask& task, const PoseCandidate& by_edges, const Track& track,
                              const SupportScorer& scorer) {
  constexpr double kMinExplained = 0.9;
  if (!track.T_by_corners || scorer.is_lost(by_edges)) return by_edges;
  if (explained_share(pinhole_of(task), track.corners, by_edges.T_cur_ref) >= kMinExplained) return by_edges;
  const auto of_length = [&](PoseHypothesis::Refinement refinement) {
    return align(task.pyramid, task.reference.cloud, {*track.T_by_corners, refinement},
                 task.params.alignment);
  };
  const PoseCandidate held = of_length(PoseHypothesis::Refinement::kNearLength);
  const PoseCandidate other = of_length(PoseHypothesis::Refinement::kLength);
  // A bent map supports any length.
  const bool is_other = kUnusualLikelihood * scorer.score(other) > scorer.score(held);
  if (scorer.is_lost(is_other ? other : held)) return by_edges;
  return is_other ? other : held;
}

// ---- rolling shutter: edges/image_correction.h ----

// Refines the pose with the cloud shifted to where the rows of this image show it.
TrackResult track_rows(const TrackingTask& task, const PoseCandidate& first, const Vector6d& twist,
                       const SupportScorer& scorer) {
  const AlignmentParams& params = task.params.alignment;
  if (task.rows.is_rolling() && !scorer.is_lost(first)) {
    const ReferenceCloud shifted = shift_cloud(
        task.rows.cameras, task.reference.cloud, first.T_cur_ref, task.rows.row_time_s, task.rows.expected,
        measured_motion(pinhole_of(task), task.reference, task.rows, first.T_cur_ref, twist,
                        task.motion.turning()));
    PoseHypothesis hypothesis{first.T_cur_ref, PoseHypothesis::Refinement::kFinestEdges};
    hypothesis.turn = first.turn;
    const PoseCandidate again = align(task.pyramid, shifted, hypothesis, params);
    if (!scorer.is_lost(again)) return assess(task.pyramid, shifted, again, params);
  }
  return assess(task.pyramid, task.reference.cloud, first, params);
}

// ---- rotation by another sensor ----

// The rotation that the edges alone would have: where their cost, of Hessian H, and the prior's, of weight W,
// are least together at a rotation e beyond the prior's, the edges alone are least H^-1 W e further.
RotationByImage rotation_by_image(const TrackResult& found) {
  RotationByImage by_image{found.T_cur_ref.rotation(), found.covariance.bottomRightCorner<3, 3>()};
  if (!found.turn) return by_image;
  const Eigen::Matrix3d weight = found.turn->weight(found.T_cur_ref);
  Matrix6d H = found.stats.information;
  H.bottomRightCorner<3, 3>() -= weight;
  Vector6d pull = Vector6d::Zero();
  pull.tail<3>() = weight * found.turn->beyond(found.T_cur_ref);
  const Eigen::Vector3d further = H.ldlt().solve(pull).tail<3>();
  by_image.R_cur_ref = rotation_of(further) * by_image.R_cur_ref;
  return by_image;
}

// Covariance of the pose with the prior as a measurement (Kalman's update).
void add_turn(TrackResult* found) {
  if (!found->turn) return;
  const Eigen::Matrix<double, 6, 3> of_rotation = found->covariance.rightCols<3>();
  const Eigen::Matrix3d both = of_rotation.bottomRows<3>() + found->turn->covariance(found->T_cur_ref);
  found->covariance -= of_rotation * both.inverse() * of_rotation.transpose();
}

// ---- the steps that are the same with and without corners ----

std::optional<MedianMotionPrior> prior_of(const TrackingTask& task) {
  if (!task.params.alignment.use_median_motion_prior) return std::nullopt;
  return MedianMotionPrior::of(task.motion, task.median_step);
}

// `prior` must outlive the result.
SupportScorer scorer_of(const TrackingTask& task, const std::optional<MedianMotionPrior>& prior) {
  return SupportScorer(task.params.status,
                       [&prior](const SE3& T_cur_ref) { return prior ? prior->likelihood(T_cur_ref) : 1.0; });
}

void measure_pose(const TrackingTask& task, const PoseCandidate& chosen, const SupportScorer& scorer,
                  Track* track) {
  const PoseCandidate pose = hold_to_corners(task, chosen, *track, scorer);
  track->twist = task.motion.twist(pose.T_cur_ref);
  track->result = track_rows(task, pose, track->twist, scorer);
  track->by_image = rotation_by_image(track->result);
  add_turn(&track->result);
  track->step_sigmas = step_sigmas(task.motion, task.median_step, track->result.T_cur_ref);
}

}  // namespace

ImageMotion measured_motion(const Pinhole& pinhole, const Reference& reference, const RowRectification& rows,
                            const SE3& T_cur_ref, const Vector6d& twist, const Eigen::Vector3d& turning) {
  if (rows.expected.is_known()) return {twist, rows.expected.idepth, turning};
  ImageMotion motion = image_motion(pinhole, reference.cloud, T_cur_ref, twist, reference.median_idepth);
  motion.turning = turning;
  return motion;
}

Track track_frame(const TrackingTask& task) {
  Track track;
  const ReferenceCloud& cloud = task.reference.cloud;
  const std::vector<SE3> starts = task.motion.starts();
  const std::optional<MedianMotionPrior> prior = prior_of(task);
  const SupportScorer scorer = scorer_of(task, prior);
  const std::vector<Proposer> proposers{
      propose_starts(starts, scorer, task.turn),
      propose_rotations(task.pyramid, cloud, starts.front(), scorer),
      propose_median_motion(task, prior, scorer),
      propose_corner_motion(task, scorer, &track),
  };
  const PoseChoice choice = choose(proposers, task.pyramid, cloud, scorer, task.params.alignment);
  if (task.corners_later && !scorer.is_lost(choice.pose) && calls_for_corners(task, choice.pose, scorer))
    track.wants_corners = choice.pose;
  track.used_median_motion = choice.kind == ProposerKind::kMedianMotion;
  measure_pose(task, choice.pose, scorer, &track);
  return track;
}

Track add_corners(const TrackingTask& task, const PoseCandidate& by_edges) {
  Track track;
  const std::optional<MedianMotionPrior> prior = prior_of(task);
  const SupportScorer scorer = scorer_of(task, prior);
  PoseCandidate best = by_edges;
  for (const PoseHypothesis& hypothesis : corner_hypotheses(task, &track)) {
    PoseCandidate candidate = align(task.pyramid, task.reference.cloud, hypothesis, task.params.alignment);
    if (scorer.score(candidate) > scorer.score(best)) best = std::move(candidate);
  }
  measure_pose(task, best, scorer, &track);
  return track;
}

Track zero_velocity_update(const TrackingTask& task, const SE3& T_cur_ref) {
  const AlignmentParams& params = task.params.alignment;
  const ReferenceCloud& cloud = task.reference.cloud;
  // Where the edges would have it; only its statistics count.
  PoseCandidate held =
      align(task.pyramid, cloud, {T_cur_ref, PoseHypothesis::Refinement::kFinestEdges}, params);
  held.T_cur_ref = T_cur_ref;
  held.evidence = weigh_evidence(task.pyramid, cloud, T_cur_ref, params);
  Track track;
  track.is_zero_velocity = true;
  track.twist = task.motion.twist(T_cur_ref);
  track.result = assess(task.pyramid, cloud, held, params);
  track.step_sigmas = step_sigmas(task.motion, task.median_step, T_cur_ref);
  return track;
}

}  // namespace edgevo
