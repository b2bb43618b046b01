// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// `edgevo eval` on folders of finished runs.
#include <functional>
#include <string>
#include <vector>

#include "edgevo/evaluation/alignment_hints.h"
#include "edgevo/evaluation/evaluate.h"
#include "edgevo/frame_evaluation/frame_figures.h"

namespace edgevo {

/// What to evaluate, and how.
struct RunEvaluationRequest {
  /// Folders of runs, or folders that hold some. The last path may be the ground truth of all (a file, or the
  /// folder of a data set); by default it is that which each run recorded.
  std::vector<std::string> paths;
  /// Options for the trajectory of a single run.
  EvaluationOptions options;
  /// FrameEvaluationOptions::stated_noise.
  TruthNoise stated_noise;
  /// JSON instead of a table.
  bool json = false;
  /// Reading of all ground truth.
  TrajectoryReading truth_reading;
  /// Called with each hint (alignment_hints()) on a single run.
  std::function<void(const std::string&)> on_hint;
};

/// Evaluates runs. One run: like its trajectory_tum.txt, with the figures of its single frames; several: a
/// table of these figures, one line each and pooled over all, and over normal and changed light where jobs of
/// a benchmark say so. Throws InputError for a run without ground truth.
std::string evaluate_runs(const RunEvaluationRequest& request);

}  // namespace edgevo
