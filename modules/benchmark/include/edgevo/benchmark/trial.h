#pragma once
// The figures of one run that a benchmark's table is made of, as a value that is written to a file and read
// back.
#include <limits>
#include <string>

#include "edgevo/core/params.h"
#include "edgevo/core/records.h"
#include "edgevo/evaluation/evaluate.h"

namespace edgevo {

/// One sequence, variant and seed.
struct Trial {
  int frames = 0;                 ///< put in
  double completion_percent = 0;  ///< of them, with a pose
  int segments = 0;               ///< with a pose
  double cpu_ms = 0;  ///< of the odometry a frame, all threads; images are read or rendered beforehand
  bool evaluated =
      false;            ///< against ground truth; if not, `note` says why and the figures below say nothing
  std::string note;     ///< why there are no errors; else empty
  double path_m = 0;    ///< of the ground truth
  double ate_m = 0;     ///< RMSE after Sim(3)
  double ate200_m = 0;  ///< scale re-corrected every 200 input frames (absolute_error.h)
  double drift_cm_per_m = 0;        ///< mean (relative_error.h)
  double failure_percent = 0;       ///< of the stretches of the drift: above its cap, or without poses
  double track_ms = 0, map_ms = 0;  ///< CPU a frame: edges, alignment and corners; all other stages

  void visit(KeyVisitor& v);  ///< names of the fields, for the file of a trial (core/params.h)
};

/// What the run itself tells; `cpu_s` of all its frames.
Trial trial_of(const Run& run, double cpu_s);

/// Adds the errors to a trial.
void add_errors(const TrajectoryEvaluation& evaluation, Trial* trial);

}  // namespace edgevo
