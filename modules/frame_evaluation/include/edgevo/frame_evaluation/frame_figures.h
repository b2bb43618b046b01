// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Figures of the evaluation of single frames (evaluate_frames.h), of one run or pooled over many: how many of
// the wrong frames the program notices, and at which price.
//
//   std::vector<FrameEvaluation> runs = ...;
//   std::cout << frame_figures_table({{"all", figures_of(runs)}});
//
// Pooled figures count frames, not runs; the longest intervals are those of any run.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/evaluation/figures.h"
#include "edgevo/frame_evaluation/evaluate_frames.h"

namespace edgevo {

/// Quantiles of the normalised squared errors of the poses; expected median of six degrees of freedom 5.3,
/// 5 % below 1.6, 5 % above 12.6.
struct NeesFigures {
  /// Number of frames.
  int frames = 0;
  /// Quantiles at 5, 50 and 95 %.
  double low = 0, median = 0, high = 0;
};

/// Figures of single frames. Absent: there is no frame of that kind.
struct FrameFigures {
  /// Number of runs, and of their input frames.
  int runs = 0, frames = 0;
  /// Number of frames evaluated, and of those that cannot be for the noise of the truth.
  int frames_evaluated = 0, below_noise = 0;
  /// Number of wrong frames, and of those that the program notices.
  int wrong = 0, noticed = 0;
  /// Number of right frames (without the ten after a wrong one), and of those that raise an alarm.
  int right = 0, false_alarms = 0;
  /// FrameEvaluation::longest_unnoticed and longest_off_scale of the worst run, frames.
  int longest_unnoticed = 0, longest_off_scale = 0;
  /// Recall: noticed / wrong; false alarms / right; percent.
  std::optional<double> recall_percent, false_alarm_percent;
  /// Area under the ROC: the probability that a wrong frame has a lower score (FrameError::score) than a
  /// right one, equal ones counting half; 0.5: the score says nothing.
  std::optional<double> roc;
  /// Whether the score is that of the state in some run, since p_right is unknown.
  bool is_roc_of_state = false;
  /// Expected calibration error: difference between the mean p_right and the share of right motions, over ten
  /// bins of equal width, weighted by their frames. A p_right speaks of the ten frames up to it.
  std::optional<double> calibration_error;
  /// NEES over six degrees of freedom.
  std::optional<NeesFigures> nees;
};

/// Figures pooled over runs. Cost: frames times the logarithm of their number.
FrameFigures figures_of(const std::vector<FrameEvaluation>& runs);

/// Evaluations of the two trajectories of a run. The covariance belongs to the pose relative to a keyframe,
/// which the final poses keep while the live ones are relative to a map that has moved since: the NEES of
/// both is that of the final poses.
struct FrameEvaluations {
  /// The live trajectory: what a planner got; the figures that stand first.
  FrameEvaluation live;
  /// The final trajectory: what the map is made of.
  FrameEvaluation final;
};
/// Evaluates the frames of both trajectories of a run.
FrameEvaluations evaluate_frames_of(const Run& run, const Trajectory& truth,
                                    const FrameEvaluationOptions& options = {});
/// The same from the folder of a run (read_reported_frames()). Throws InputError.
FrameEvaluations evaluate_frames_in(const std::string& folder, const Trajectory& truth,
                                    const FrameEvaluationOptions& options = {});

/// Figures with their title: a run, or a group of runs.
struct NamedFigures {
  /// Title of the row.
  std::string name;
  /// The figures.
  FrameFigures figures;
};

/// Aligned text: a line of titles, then a line for each.
std::string frame_figures_table(const std::vector<NamedFigures>& rows);
/// The same as a table in Markdown.
std::string frame_figures_markdown(const std::vector<NamedFigures>& rows);
/// The same as a JSON array of objects, indented by two spaces. Absent figures are null.
std::string frame_figures_json(const std::vector<NamedFigures>& rows);

/// The table under a line on the noise of the ground truth and the frames of the first row that it hides:
/// goes below to_table() of a trajectory.
std::string frame_section(const std::vector<NamedFigures>& rows, const TruthNoise& noise);
/// The same for to_json() of a trajectory.
std::vector<JsonMember> frame_members(const std::vector<NamedFigures>& rows, const TruthNoise& noise);

}  // namespace edgevo
