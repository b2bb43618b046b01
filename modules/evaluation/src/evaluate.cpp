// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/evaluate.h"

#include <algorithm>

#include "edgevo/core/error.h"
#include "edgevo/evaluation/absolute_error.h"
#include "edgevo/evaluation/relative_error.h"

namespace edgevo {
namespace {

// Windows of the scale curve: about six make a curve; a scale needs ten frames, and more than fifty average
// its drift away.
constexpr int kScaleWindowsAtLeast = 6;
constexpr int kShortestScaleWindow = 10, kLongestScaleWindow = 50;  // input frames

TrajectoryFacts facts_of(const Trajectory& t) {
  return {t.path, std::string(to_string(t.format)), int(t.poses.size())};
}

// KITTI files have no times: compared with a TUM file of as many poses, they take its times line by line.
void copy_times(const Trajectory& from, Trajectory* to) {
  if (from.poses.size() != to->poses.size())
    throw InputError(to->path,
                     "is a KITTI file of " + std::to_string(to->poses.size()) + " poses without times, and " +
                         from.path + " has " + std::to_string(from.poses.size()),
                     "give both in the TUM format, or both in KITTI's");
  for (size_t i = 0; i < to->poses.size(); ++i) to->poses[i].time = from.poses[i].time;
}

void reconcile_times(Trajectory* estimate, Trajectory* ground_truth) {
  const bool kitti_est = estimate->format == TrajectoryFormat::kKitti;
  const bool kitti_gt = ground_truth->format == TrajectoryFormat::kKitti;
  if (kitti_est && !kitti_gt) copy_times(*ground_truth, estimate);
  if (kitti_gt && !kitti_est) copy_times(*estimate, ground_truth);
  if (kitti_est && kitti_gt && estimate->poses.size() > ground_truth->poses.size())
    throw InputError(estimate->path, "has more lines than " + ground_truth->path,
                     "KITTI files have one line per frame; give the ground truth of the whole sequence");
}

void require_motion(const Points& points, const std::string& path) {
  if (coincide(points))
    throw InputError(path, "all its positions are equal",
                     "nothing can be aligned; give a trajectory that moves");
}

Coverage coverage_of(const std::vector<EvaluatedFrame>& frames, const std::string& source) {
  Coverage c;
  c.source = source;
  c.input_frames = int(frames.size());
  const auto posed = [](const EvaluatedFrame& f) { return f.has_pose; };
  c.with_pose = int(std::count_if(frames.begin(), frames.end(), posed));
  c.before_first_pose = int(std::find_if(frames.begin(), frames.end(), posed) - frames.begin());
  c.lost = c.input_frames - c.with_pose - c.before_first_pose;
  c.completion_percent = 100.0 * c.with_pose / c.input_frames;
  c.failure_percent = 100.0 * c.lost / c.input_frames;
  return c;
}

AbsoluteError required(const std::optional<AbsoluteError>& error, const std::string& path) {
  if (!error)
    throw InputError(path, "no similarity fits it to the ground truth",
                     "check that both are the same sequence");
  return *error;
}

}  // namespace

TrajectoryEvaluation evaluate(const Trajectory& estimate_in, const Trajectory& ground_truth_in,
                              const EvaluationOptions& options) {
  Trajectory estimate = estimate_in, ground_truth = ground_truth_in;
  reconcile_times(&estimate, &ground_truth);
  const InputFrames input = find_input_frames(estimate, ground_truth, options.frames_total);
  const TimeMatches a = match_by_time(estimate, ground_truth, input);
  require_motion(estimate_points(a.matches), estimate.path);
  require_motion(truth_points(a.matches), ground_truth.path);

  TrajectoryEvaluation e;
  e.estimate = facts_of(estimate);
  e.ground_truth = facts_of(ground_truth);
  e.matched = int(a.matches.size());
  e.without_ground_truth = a.without_ground_truth;
  e.block_frames = options.rescale_block_frames;
  e.coverage = coverage_of(a.frames, input.source);
  e.ate_sim3 = required(ate_sim3(a.matches), estimate.path);
  e.ate_se3 = required(ate_se3(a.matches), estimate.path);
  const std::vector<MatchedPose> metric =
      rescale_blocks(a.matches, options.rescale_block_frames, e.ate_sim3.scale);
  e.ate_blocks = required(ate_se3(metric), estimate.path);
  e.drift = drift(a.frames, metric, options.drift_cap_cm_per_m);
  e.kitti = kitti_relative(a.frames, a.matches, e.ate_sim3.scale);
  e.scale_window_frames =
      std::clamp(e.coverage.input_frames / kScaleWindowsAtLeast, kShortestScaleWindow, kLongestScaleWindow);
  e.scale_curve = scale_curve(a.matches, e.scale_window_frames, e.ate_sim3.scale);
  return e;
}

}  // namespace edgevo
