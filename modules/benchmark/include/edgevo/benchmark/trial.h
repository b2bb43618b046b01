// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Figures of one run of a benchmark, as a value that is written to a file and read back.
#include <limits>
#include <string>

#include "edgevo/core/params.h"
#include "edgevo/core/records.h"
#include "edgevo/evaluation/evaluate.h"
#include "edgevo/frame_evaluation/frame_figures.h"

namespace edgevo {

/// Figures of one sequence, variant and seed.
struct Trial {
  /// Number of input frames.
  int frames = 0;
  /// Share of the input frames with a pose, percent.
  double completion_percent = 0;
  /// Number of connected segments of trajectory.
  int segments = 0;
  /// CPU time of the odometry per frame, all threads, without reading or rendering images, milliseconds.
  double cpu_ms = 0;
  /// Whether the trial was compared with ground truth; if not, the error figures below are meaningless.
  bool evaluated = false;
  /// Reason why there are no error figures; else empty.
  std::string note;
  /// Length of the true path, metres.
  double path_m = 0;
  /// ATE (RMSE) after a Sim(3) fit, metres.
  double ate_m = 0;
  /// ATE200, scale re-corrected every 200 input frames (absolute_error.h), metres.
  double ate200_m = 0;
  /// Mean drift (relative_error.h), cm/m.
  double drift_cm_per_m = 0;
  /// Share of the intervals of the drift that exceed its cap or lack poses, percent.
  double failure_percent = 0;
  /// CPU time per frame of edges, alignment and corners, and of all other stages, milliseconds.
  double track_ms = 0, map_ms = 0;

  /// Largest deviation of the scale of an interval of a sixth of the sequence, of 10 to 50 frames, from that
  /// of the whole sequence (TrajectoryEvaluation::scale_curve), percent: 100 for half and for double the
  /// scale.
  double scale_error_percent = 0;
  /// Number of doubtful frames (core/doubtful_frame.h).
  int doubtful_frames = 0;
  /// Whether `edgevo run` would end with exit code 3: most frames have no pose, or too many are doubtful.
  bool has_failed = false;

  // Errors of the single frames of the live trajectory (frame_evaluation/frame_figures.h).

  /// Number of frames evaluated, wrong, and wrong and noticed.
  int evaluated_frames = 0, wrong_frames = 0, noticed_frames = 0;
  /// Number of right frames, and of those with an alarm.
  int right_frames = 0, false_alarms = 0;
  /// Longest intervals of wrong frames, and of frames whose scale is off, without a word, frames.
  int longest_unnoticed = 0, longest_off_scale = 0;
  /// Area under the ROC, expected calibration error of p_right, median NEES; -1: unknown.
  double roc_area = -1, calibration_error = -1, nees_median = -1;

  /// Visits the fields, for the file of a trial (core/params.h).
  void visit(KeyVisitor& v);
};

/// Figures of a run without ground truth; `cpu_s` is the CPU time of all its frames, seconds.
Trial trial_of(const Run& run, double cpu_s);

/// Adds the error figures to a trial.
void add_errors(const TrajectoryEvaluation& evaluation, Trial* trial);
/// Adds the figures of its frames to a trial.
void add_frame_figures(const FrameFigures& figures, Trial* trial);

}  // namespace edgevo
