// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Evaluates every frame of a run against ground truth: was the motion from it right, and if not, did the
// program say so?
//
//   const Trajectory truth = read_trajectory("groundtruth_tum.txt");
//   const FrameEvaluation live = evaluate_frames(read_reported_frames("out", PoseSource::kLive), truth);
//   for (const FrameError& v : live.frames) if (v.is_evaluated && v.wrong && !v.noticed) ...
//
// WRONG: the motion over the next ten frames misses the true one by more than 25 % of its length and by more
// than 2 % of the map's median depth, or by more than 3 degrees.
//
// Scale. A monocular run has a unit of its own, so the motion is measured in the scale of the fifty frames
// before: the median of the ratios of step lengths, run over truth, weighted by the true length. Steps in
// which the truth moves by less than five of its standard deviations are skipped (if these are most steps,
// steps of two, five or ten frames are taken), and the last fifty others count, however long ago: a camera
// that stands keeps its scale. A segment has a unit of its own. Its first frames, with fewer than ten steps
// before them, are measured in the scale of its first ten steps: nobody can be wrong about a unit that has
// just been chosen, but the shape of the path must be right. Without any step the translation is evaluated
// only if the truth stands throughout the segment, to the noise that it shows: what the run moves is then its
// error, in shares of the median depth.
//
// Truth of another body. If a constant rotation (up to 15 degrees) and a lever arm between the camera and
// what the truth describes (a GPS unit) reduce the median error by a third, and the rotations fit as well as
// before, the truth is moved to the camera first.
//
// Ends. A motion ends with the last frame among the next ten that has a pose in the same segment, and truth.
// If that is less than five frames ahead it is not evaluated. So what comes just before a loss is evaluated
// as far as it goes; a motion across the border of two segments is not, since the program itself calls that
// joint a guess. A gap within a segment (lost and relocalised) is bridged: the program reported to be where
// it was.
//
// Not evaluated either: frames without a pose or in state BOOTSTRAPPING, whose pose came afterwards; frames
// without truth; frames whose depth is unknown throughout the segment; and frames where the noise of the
// truth (truth_noise.h, three sigmas of a difference of two poses) decides on which side of the bound they
// lie.
//
// NOTICED: one of the frames from here to ten frames on has no pose, or a state that is not TRACKING, or a
// p_right below the threshold. A right frame is a FALSE ALARM if that holds for the frame itself; right
// frames within ten frames after a wrong one do not count ("aftermath"), for there the alarm is due.
#include <limits>
#include <vector>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/motion_tolerance.h"
#include "edgevo/evaluation/trajectory.h"
#include "edgevo/frame_evaluation/reported_frame.h"
#include "edgevo/frame_evaluation/truth_noise.h"

namespace edgevo {

/// Bounds beyond which a motion is wrong, and what it is measured in.
struct FrameEvaluationOptions {
  /// Length of the motion that is evaluated, and time to notice, input frames.
  int ahead_frames = kMotionTolerance.frames;
  /// Shortest piece of such a motion that is evaluated, input frames.
  int fewest_ahead_frames = 5;
  /// Number of steps before it whose scale the motion is measured in.
  int scale_frames = 50;
  /// Fewest steps that make a scale.
  int fewest_scale_steps = 10;
  /// A translation is wrong above both: share of its length, and of the median depth.
  double miss_of_length = kMotionTolerance.share_of_length, miss_of_depth = kMotionTolerance.share_of_depth;
  /// A rotation is wrong above, degrees.
  double miss_deg = kMotionTolerance.rotation_deg;
  /// The program says so with a p_right below.
  double p_threshold = kDoubtfulBelow;
  /// The local scale is off if it differs by more than this factor.
  double scale_factor = 1.5;
  /// Noise of the truth that is known from elsewhere; it counts where it is larger than truth_noise().
  TruthNoise stated_noise;
};

/// Result for the motion that begins at one input frame. NaN: unknown.
struct FrameError {
  /// Value of an unknown number.
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  /// Whether the frame can be evaluated; if not, `wrong`, `noticed` and `aftermath` are false.
  bool is_evaluated = false;
  /// Whether it cannot be for the noise of the truth alone.
  bool below_noise = false;
  /// Whether the motion is wrong.
  bool wrong = false;
  /// Whether it is wrong and the program says so.
  bool noticed = false;
  /// Whether it is right, within ten frames after a wrong one.
  bool aftermath = false;
  /// Whether the program doubts this very frame: no pose, not TRACKING, or p_right below the threshold.
  bool alarm = false;
  /// Position in the list of the frame with which the motion ends; -1: there is none.
  int end = -1;
  /// True length of the motion, and length of its error in the scale of the frames before, metres.
  double length_m = kUnknown, miss_m = kUnknown;
  /// Error of its rotation, degrees.
  double miss_deg = kUnknown;
  /// Error of the translation as a share of the map's median depth; without a scale that of a run whose truth
  /// stands.
  double miss_of_depth = kUnknown;
  /// Scale of the frames before, units of the run per metre.
  double units_per_m = kUnknown;
  /// Scale of the motion over that of the frames before: 1: right, 0.4: the steps have shrunk.
  double scale_ratio = kUnknown;
  /// Whether the local scale is off since the last word of the program (FrameEvaluation::longest_off_scale).
  bool off_scale = false;
  /// Lowest p_right from the frame to ten frames on, by which it ranks for the ROC. Where p_right is unknown
  /// the state counts: TRACKING 1, DEGRADED 0.5, else 0.
  double score = kUnknown;
  /// p_right of the frame with which a motion of full length ends, for the calibration: it was known when the
  /// motion had been seen.
  double p_end = kUnknown;
};

/// Results for the frames of a run.
struct FrameEvaluation {
  /// One for each input frame.
  std::vector<FrameError> frames;
  /// Noise of the truth.
  TruthNoise noise;
  /// Camera on the body that the truth describes; the identity if that is the camera.
  SE3 T_body_cam;
  /// Longest interval of wrong frames in a row of which the program said nothing, frames. Frames that are not
  /// evaluated neither count nor end it.
  int longest_unnoticed = 0;
  /// Longest interval without a word whose local scale (over the next ten frames) differs by more than
  /// FrameEvaluationOptions::scale_factor from that of the fifty steps after the last word of the program, or
  /// after the segment's beginning. This finds a scale that creeps, which the fifty frames before hide.
  int longest_off_scale = 0;
  /// Squared errors of the poses relative to their reference keyframes, normalised by their covariance plus
  /// the noise of the truth (NEES); expected 6. One for each frame with a covariance and truth, in the scale
  /// of the frames before; keyframes, whose pose was adjusted afterwards, are skipped.
  std::vector<double> nees;
  /// Whether p_right is known for some frame.
  bool has_p_right = false;
  /// Whether the median depth is known for some frame.
  bool has_depth = false;
};

/// Evaluates the frames of a run. `truth` is in metres, with times of the same clock. Deterministic; cost:
/// linear, times 50.
FrameEvaluation evaluate_frames(const std::vector<ReportedFrame>& reported, const Trajectory& truth,
                                const FrameEvaluationOptions& options = {});

}  // namespace edgevo
