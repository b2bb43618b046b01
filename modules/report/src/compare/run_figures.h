#pragma once
// What the row of a run says in the page of `edgevo compare`, and where its path lies beside the truth.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/evaluation/evaluate.h"
#include "edgevo/report/compare_page.h"

namespace edgevo {

using GroundPath = std::vector<std::pair<double, double>>;  ///< (forward, left), from above

struct RunFigures {
  const ComparedRun* run = nullptr;
  std::string note;  ///< why there is no error figure; empty: there is, or no truth is known
  std::optional<TrajectoryEvaluation> evaluation;  ///< against the ground truth
  std::shared_ptr<const Trajectory> truth;         ///< the same object for runs with equal ground truth
  GroundPath path;        ///< aligned with the truth in metres, or in the run's own unit
  GroundPath truth_path;  ///< beside it; empty without truth

  /// RMSE over the length of the true path; NaN without.
  double ate_percent() const;
  double completion_percent() const;
  /// Last over first of the curve of the scale; NaN without.
  double scale_drift() const;
};

/// Ground truths, each read once; files with the same poses are the same truth.
class GroundTruths {
 public:
  /// Throws InputError.
  std::shared_ptr<const Trajectory> read(const std::string& path);

 private:
  std::map<std::string, std::shared_ptr<const Trajectory>> by_path_, by_text_;
};

RunFigures figures_of(const ComparedRun& run, GroundTruths* truths);

/// True where `a` is to stand before `b`: what could not be read; then what has no error figure though the
/// truth is known; then by the error relative to the path; then, without truth, by the frames without a pose.
bool is_worse(const RunFigures& a, const RunFigures& b);

}  // namespace edgevo
