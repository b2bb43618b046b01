#include "frame_tracker.h"

#include "edgevo/core/thread_clock.h"
#include "steady_motion.h"

namespace edgevo {
namespace {

const Pinhole& pinhole_of(const TrackingTask& task) { return task.pyramid.finest().pinhole; }

// ---- proposers: the cheapest and likeliest first ----

// The step of a camera that is under way evenly, where what was found is another one.
Proposer propose_usual_step(const TrackingTask& task, const std::optional<UsualStep>& usual,
                            const PoseJudge& judge) {
  return {ProposerKind::kMedianMotion,
          [&](const PoseCandidate& best) {
            return usual && !task.was_lost && !judge.is_lost(best) && usual->is_unusual(best.T_cur_ref) &&
                   usual->is_apart(pinhole_of(task), task.reference.cloud, best.T_cur_ref);
          },
          [&] { return std::vector<PoseHypothesis>{usual->hypothesis()}; }};
}

// About to be lost; or with few inliers while the map moves on at every frame: large motion. At small motion
// bad light does that, and it misleads corners, too.
bool calls_for_corners(const TrackingTask& task, const PoseCandidate& pose, const PoseJudge& judge) {
  if (task.was_lost || !(pose.evidence.inlier_share < task.params.mapping.corners.max_inlier_share))
    return false;
  return judge.is_lost(pose) || (task.keyframes.follows_keyframe() &&
                                 task.keyframes.calls_for_keyframe(pose.T_cur_ref, task.reference));
}

// A hypothesis from corners (mapping/corner_motion.h), searched from the predicted pose, not from the one
// that the edges led to: rotation and direction from corners, the length from the edges.
std::vector<PoseHypothesis> corner_hypotheses(const TrackingTask& task, Track* track) {
  const double start = thread_cpu_ms();
  const SE3 expected = task.motion.predict();
  std::vector<PoseHypothesis> hypotheses;
  std::optional<CornerMotion> found =
      find_corner_motion(pinhole_of(task), *task.reference.cloud.pyramid, task.pyramid, expected,
                         task.params.mapping.corners, task.random);
  if (found) {
    const SE3 T_cur_ref(found->T_to_from.rotation(),
                        expected.translation().norm() * found->T_to_from.translation());
    hypotheses.push_back({T_cur_ref, PoseHypothesis::Refinement::kLengthThenEdges});
    // At large motion they go with the frame into the adjustment, whichever pose wins.
    if (task.keyframes.follows_keyframe()) track->corners = std::move(found->pairs);
  }
  track->corner_ms = thread_cpu_ms() - start;
  return hypotheses;
}

Proposer propose_corner_motion(const TrackingTask& task, const PoseJudge& judge, Track* track) {
  return {ProposerKind::kCorners,
          [&](const PoseCandidate& best) { return calls_for_corners(task, best, judge); },
          [&task, track] { return corner_hypotheses(task, track); }};
}

// ---- rolling shutter: edges/image_correction.h ----

// The pose once more, with the cloud moved to where the rows of this image show it.
TrackResult track_rows(const TrackingTask& task, const PoseCandidate& first, const Vector6d& twist,
                       const PoseJudge& judge) {
  const AlignmentParams& params = task.params.alignment;
  if (task.rows.is_rolling() && !judge.is_lost(first)) {
    const ReferenceCloud shifted = shift_cloud(
        pinhole_of(task), task.reference.cloud, first.T_cur_ref, task.rows.readout_s, task.rows.expected,
        measured_motion(pinhole_of(task), task.reference, task.rows, first.T_cur_ref, twist));
    const PoseCandidate again =
        align(task.pyramid, shifted, {first.T_cur_ref, PoseHypothesis::Refinement::kFinestEdges}, params);
    if (!judge.is_lost(again)) return assess(task.pyramid, shifted, again, params);
  }
  return assess(task.pyramid, task.reference.cloud, first, params);
}

}  // namespace

ImageMotion measured_motion(const Pinhole& pinhole, const Reference& reference, const RowRectification& rows,
                            const SE3& T_cur_ref, const Vector6d& twist) {
  if (rows.expected.is_known()) return {twist, rows.expected.idepth};
  return image_motion(pinhole, reference.cloud, T_cur_ref, twist, reference.median_idepth);
}

Track track_frame(const TrackingTask& task) {
  Track track;
  const AlignmentParams& params = task.params.alignment;
  const ReferenceCloud& cloud = task.reference.cloud;
  const std::vector<SE3> starts = task.motion.starts();
  const std::optional<UsualStep> usual =
      params.use_median_motion_prior ? UsualStep::of(task.motion) : std::nullopt;
  const PoseJudge judge(params,
                        [&](const SE3& T_cur_ref) { return usual ? usual->likelihood(T_cur_ref) : 1.0; });
  const std::vector<Proposer> proposers{
      propose_starts(starts, judge),
      propose_rotations(task.pyramid, cloud, starts.front(), judge),
      propose_usual_step(task, usual, judge),
      propose_corner_motion(task, judge, &track),
  };
  const PoseChoice choice = choose(proposers, task.pyramid, cloud, judge, params);
  track.took_usual_step = choice.kind == ProposerKind::kMedianMotion;
  track.twist = task.motion.twist(choice.pose.T_cur_ref);
  track.result = track_rows(task, choice.pose, track.twist, judge);
  return track;
}

}  // namespace edgevo
