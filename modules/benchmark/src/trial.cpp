// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/trial.h"

#include <algorithm>

#include "edgevo/run_quality/run_statistics.h"

namespace edgevo {

void Trial::visit(KeyVisitor& v) {
  // No limits: the program wrote the values itself.
  constexpr int kMany = std::numeric_limits<int>::max();
  constexpr double kLarge = std::numeric_limits<double>::max();
  v.integer("frames", frames, 0, kMany, "input frames");
  v.number("completion_percent", completion_percent, 0, 100, "frames with a pose");
  v.integer("segments", segments, 0, kMany, "connected segments of trajectory");
  v.number("cpu_ms", cpu_ms, 0, kLarge, "CPU time of the odometry per frame");
  v.boolean("evaluated", evaluated, "whether compared with ground truth");
  v.text("note", note, {}, "reason if not");
  v.number("path_m", path_m, 0, kLarge, "length of the true path");
  v.number("ate_m", ate_m, 0, kLarge, "RMSE after Sim(3)");
  v.number("ate200_m", ate200_m, 0, kLarge, "scale re-corrected every 200 input frames");
  v.number("drift_cm_per_m", drift_cm_per_m, 0, kLarge, "mean over intervals");
  v.number("failure_percent", failure_percent, 0, 100,
           "share of intervals above the cap of the drift or without poses");
  v.number("scale_error_percent", scale_error_percent, 0, kLarge, "largest of the scale of an interval");
  v.integer("doubtful_frames", doubtful_frames, 0, kMany, "frames that the program doubts");
  v.boolean("has_failed", has_failed, "whether the exit code of a run would be 3");
  v.number("track_ms", track_ms, 0, kLarge, "edges, alignment and corners, per frame");
  v.number("map_ms", map_ms, 0, kLarge, "all other stages, per frame");
  v.integer("judged_frames", evaluated_frames, 0, kMany, "frames compared with ground truth one by one");
  v.integer("wrong_frames", wrong_frames, 0, kMany, "of these, with a wrong motion over the next ten");
  v.integer("noticed_frames", noticed_frames, 0, kMany, "of these, noticed by the program");
  v.integer("right_frames", right_frames, 0, kMany, "frames with a right motion");
  v.integer("false_alarms", false_alarms, 0, kMany, "of these, with an alarm");
  v.integer("longest_unnoticed", longest_unnoticed, 0, kMany, "wrong frames in a row without a word");
  v.integer("longest_off_scale", longest_off_scale, 0, kMany, "frames in a row with a scale that is off");
  v.number("roc_area", roc_area, -1, 1, "wrong against right frames; -1: unknown");
  v.number("calibration_error", calibration_error, -1, 1, "of p_right; -1: unknown");
  v.number("nees_median", nees_median, -1, kLarge, "of the covariance; -1: unknown");
}

namespace {

bool is_tracking(const std::string& stage) {
  return stage == "edges" || stage == "alignment" || stage == "corners" || stage == "witness";
}

// Largest ratio between the scale of an interval and that of the whole, in either direction.
double scale_error_percent(const std::vector<ScalePoint>& curve) {
  double worst = 1;
  for (const ScalePoint& p : curve) worst = std::max({worst, p.relative_scale, 1 / p.relative_scale});
  return 100 * (worst - 1);
}

}  // namespace

Trial trial_of(const Run& run, double cpu_s) {
  Trial trial;
  const RunCounts counts = count(run);
  trial.frames = counts.frames;
  trial.segments = counts.segments;
  trial.doubtful_frames = counts.doubtful;
  trial.has_failed = counts.mostly_failed() || counts.is_largely_untrusted();
  for (const FrameRecord& frame : run.frames)
    for (const auto& [stage, ms] : frame.stage_ms)
      (is_tracking(stage) ? trial.track_ms : trial.map_ms) += ms / trial.frames;
  if (trial.frames == 0) return trial;
  trial.completion_percent = 100.0 * counts.with_pose / trial.frames;
  trial.cpu_ms = 1000.0 * cpu_s / trial.frames;
  return trial;
}

void add_errors(const TrajectoryEvaluation& evaluation, Trial* trial) {
  trial->evaluated = true;
  trial->ate_m = evaluation.ate_sim3.rmse;
  trial->ate200_m = evaluation.ate_blocks.rmse;
  trial->scale_error_percent = scale_error_percent(evaluation.scale_curve);
  if (!evaluation.drift) return;
  trial->path_m = evaluation.drift->path_m;
  trial->drift_cm_per_m = evaluation.drift->mean_cm_per_m;
  const Drift& drift = *evaluation.drift;
  if (drift.intervals > 0)
    trial->failure_percent = 100.0 * (drift.capped + drift.without_poses) / drift.intervals;
}

void add_frame_figures(const FrameFigures& f, Trial* trial) {
  trial->evaluated_frames = f.frames_evaluated, trial->wrong_frames = f.wrong,
  trial->noticed_frames = f.noticed;
  trial->right_frames = f.right, trial->false_alarms = f.false_alarms;
  trial->longest_unnoticed = f.longest_unnoticed, trial->longest_off_scale = f.longest_off_scale;
  trial->roc_area = f.roc.value_or(-1);
  trial->calibration_error = f.calibration_error.value_or(-1);
  trial->nees_median = f.nees ? f.nees->median : -1;
}

}  // namespace edgevo
