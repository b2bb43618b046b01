// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Figures of the judgement of single frames (frame_judge.h), of one run or pooled over many: how many of the
// wrong frames the program notices, and at which price.
//
//   std::vector<RunJudgement> runs = ...;
//   std::cout << judgement_table({{"all", figures_of(runs)}});
//
// Pooled figures count frames, not runs; the longest intervals are those of any run.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/evaluation/figures.h"
#include "edgevo/evaluation/frame_judge.h"

namespace edgevo {

/// Figures pooled over runs. Cost: frames times the logarithm of their number.
JudgementFigures figures_of(const std::vector<RunJudgement>& runs);

/// Judgements of the two trajectories of a run. The covariance belongs to the pose relative to a keyframe,
/// which the final poses keep while the live ones are relative to a map that has moved since: the NEES of
/// both is that of the final poses.
struct RunJudgements {
  /// The live trajectory: what a planner got; the figures that stand first.
  RunJudgement live;
  /// The final trajectory: what the map is made of.
  RunJudgement final;
};
/// Evaluates the frames of both trajectories of a run.
RunJudgements judge_run(const Run& run, const Trajectory& truth, const JudgementRules& rules = {});
/// The same from the folder of a run (read_claims()). Throws InputError.
RunJudgements judge_folder(const std::string& folder, const Trajectory& truth,
                           const JudgementRules& rules = {});

/// Aligned text: a line of titles, then a line for each.
std::string judgement_table(const std::vector<NamedFigures>& rows);
/// The same as a table in Markdown.
std::string judgement_markdown(const std::vector<NamedFigures>& rows);
/// The same as a JSON array of objects, indented by two spaces. Absent figures are null.
std::string judgement_json(const std::vector<NamedFigures>& rows);

}  // namespace edgevo
