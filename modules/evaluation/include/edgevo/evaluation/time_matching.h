// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which estimated poses, true poses and input frames belong together: those of the same time.
//
// Ground truth may have a rate of its own (motion capture at 100 Hz under images at 30 Hz), so it is
// interpolated to the estimate's times: positions linearly, rotations by slerp. Outside its span, or in a
// gap of more than ten of its median steps, there is no match: the position of the camera is unknown.
//
// Besides the poses, the metrics need the INPUT: the frames that the system received, with or without pose.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {

/// Interpolates ground truth. A time up to 0.1 ms outside the span (rounding of the files) counts as its end.
/// Cost: logarithmic per query, after one linear pass in the constructor.
class GroundTruth {
 public:
  /// Keeps a reference to `trajectory`, whose poses are in time order.
  explicit GroundTruth(const Trajectory& trajectory);
  /// Interpolated T_world_cam at `time`; nullopt outside the span and in long gaps.
  std::optional<SE3> at(Timestamp time) const;

 private:
  /// Not owned; the trajectory must outlive this object.
  const std::vector<StampedPose>* poses_;
  int64_t longest_gap_ticks_;
};

/// Frames that the system received, in time order.
struct InputFrames {
  /// Times, ascending.
  std::vector<Timestamp> times;
  /// Where they were found, for the report.
  std::string source;
};

/// Finds the input frames from the first of these that is available:
///   1. `frames_total` (given by the user): that many frames, spaced by the estimate's median step;
///   2. frames.csv in the folder of the trajectory (a run of `edgevo run`): its rows;
///   3. times.txt in the folder of the ground truth (a sequence in the `edgevo` layout): its lines;
///   4. the lines of the ground truth, if they contain most of the estimate's times and the median steps are
///      similar;
///   5. the span of the estimate at its median step: frames lost before its first and after its last pose are
///      not counted.
/// Throws InputError if a file of 2. or 3. exists but is broken.
InputFrames find_input_frames(const Trajectory& estimate, const Trajectory& ground_truth,
                              std::optional<int> frames_total);

/// An estimated pose with its ground truth.
struct MatchedPose {
  /// Time of the estimated pose.
  Timestamp time;
  /// Index of the nearest input frame.
  int frame = 0;
  /// Estimated pose, in its own world frame and unit.
  SE3 T_est;
  /// True pose at `time`, metres.
  SE3 T_gt;
};

/// An input frame with its match.
struct EvaluatedFrame {
  /// True pose at the time of the estimated pose if there is one, else at the time of the frame.
  std::optional<SE3> T_gt;
  /// Index into TimeMatches::matches; -1: no pose, or no ground truth for it.
  int match = -1;
  /// Whether the estimate has a pose for the frame, with or without ground truth.
  bool has_pose = false;
};

/// The estimate with its ground truth, by pose and by input frame.
struct TimeMatches {
  /// Matched poses in time order.
  std::vector<MatchedPose> matches;
  /// One entry for each input frame.
  std::vector<EvaluatedFrame> frames;
  /// Number of estimated poses without ground truth.
  int without_ground_truth = 0;
};

/// Matches `estimate` with `ground_truth`. Throws InputError if there are fewer than three matches.
TimeMatches match_by_time(const Trajectory& estimate, const Trajectory& ground_truth,
                          const InputFrames& input);

}  // namespace edgevo
