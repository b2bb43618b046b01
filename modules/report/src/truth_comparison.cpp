// SPDX-License-Identifier: BSD-3-Clause
#include "truth_comparison.h"

#include "edgevo/core/error.h"
#include "edgevo/evaluation/evaluate.h"

namespace edgevo {
namespace {

InputFrames input_of(const Run& run) {
  InputFrames input{{}, "this run"};
  for (const FrameRecord& frame : run.frames) input.times.push_back(frame.time);
  return input;
}

std::optional<Drift> drift_of(const TimeMatches& matched) {
  const EvaluationOptions options;
  const std::optional<AbsoluteError> whole = ate_sim3(matched.matches);
  if (!whole) return std::nullopt;
  const std::vector<MatchedPose> metric =
      rescale_blocks(matched.matches, options.rescale_block_frames, whole->scale);
  return drift(matched.frames, metric, options.drift_cap_cm_per_m);
}

std::optional<TruthComparison> compare(const Run& run, const Trajectory& truth) {
  const TimeMatches matched = match_by_time(trajectory_of(run), truth, input_of(run));
  const Points estimated = estimate_points(matched.matches), true_points = truth_points(matched.matches);
  const std::optional<Sim3> T_truth_run =
      run.is_metric() ? fit_se3(estimated, true_points) : fit_sim3(estimated, true_points);
  const std::optional<AbsoluteError> error =
      run.is_metric() ? ate_se3(matched.matches) : ate_sim3(matched.matches);
  if (!T_truth_run || !error) return std::nullopt;
  TruthComparison comparison{T_truth_run->scale, *error, {}, drift_of(matched)};
  for (const EvaluatedFrame& frame : matched.frames)
    comparison.p_world.push_back(
        frame.T_gt ? std::optional<Eigen::Vector3d>(T_truth_run->rigid.inverse() * frame.T_gt->translation())
                   : std::nullopt);
  return comparison;
}

}  // namespace

std::optional<TruthComparison> compare_with_truth(const Run& run, const std::string& path,
                                                  std::string* why_not) {
  why_not->clear();
  if (path.empty()) return std::nullopt;
  try {
    std::optional<TruthComparison> comparison = compare(run, read_trajectory(path));
    if (!comparison) *why_not = path + ": cannot be aligned with the run: one of the two does not move";
    return comparison;
  } catch (const InputError& e) {
    *why_not = e.what();
    return std::nullopt;
  }
}

}  // namespace edgevo
