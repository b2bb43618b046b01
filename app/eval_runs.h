// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// `edgevo eval` on folders of finished runs.
#include <functional>
#include <string>
#include <vector>

#include "edgevo/evaluation/alignment_hints.h"
#include "edgevo/evaluation/evaluate.h"
#include "edgevo/frame_evaluation/frame_figures.h"

namespace edgevo::app {

/// Evaluates the runs at or below `paths`: one run like its trajectory_tum.txt, with the figures of its
/// single frames; several as a table of these figures, one line each and pooled over all, and over normal
/// and changed light where jobs of a benchmark say so. The last path may be the ground truth of all (a file,
/// or the folder of a data set); by default it is that which each run recorded. Throws InputError for a run
/// without ground truth. `truth_reading`: of all ground truth.
int eval_runs(const std::vector<std::string>& paths, const EvaluationOptions& options,
              const TruthNoise& stated_noise, bool json, const TrajectoryReading& truth_reading,
              const std::function<Trajectory(const std::string& path)>& read_truth);

}  // namespace edgevo::app
