// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Figures and path of a run in the page of `edgevo compare`.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/evaluation/evaluate.h"
#include "edgevo/report/compare_page.h"

namespace edgevo {

/// Path from above, as (forward, left) points.
using GroundPath = std::vector<std::pair<double, double>>;

/// Figures of one run.
struct RunFigures {
  /// The run.
  const ComparedRun* run = nullptr;
  /// Reason why there are no error figures; empty: there are, or no ground truth is known.
  std::string note;
  /// Errors with respect to the ground truth.
  std::optional<TrajectoryEvaluation> evaluation;
  /// Ground truth; the same object for runs with equal ground truth.
  std::shared_ptr<const Trajectory> truth;
  /// Path of the run, aligned with the truth in metres, or in the run's own unit.
  GroundPath path;
  /// True path, metres; empty without truth.
  GroundPath truth_path;

  /// RMSE of the position in percent of the length of the true path; NaN without truth.
  double ate_percent() const;
  /// Share of frames with a pose, percent.
  double completion_percent() const;
  /// Scale at the end divided by that at the start; NaN without truth.
  double scale_drift() const;
};

/// Cache of ground truths. Files with the same text give the same object.
class GroundTruths {
 public:
  /// Reads the trajectory file at `path`. Throws InputError.
  std::shared_ptr<const Trajectory> read(const std::string& path);

 private:
  std::map<std::string, std::shared_ptr<const Trajectory>> by_path_, by_text_;
};

/// Computes the figures of a run.
RunFigures figures_of(const ComparedRun& run, GroundTruths* truths);

/// Order of the table: first runs that could not be read, then runs without error figures although their
/// truth is known, then by error relative to the path, and last runs without truth by the share of frames
/// without a pose.
bool is_worse(const RunFigures& a, const RunFigures& b);

}  // namespace edgevo
