// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of the odometry over a source and its accuracy against ground truth, for the accuracy tests.
#include <functional>
#include <ostream>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/evaluation/evaluate.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/simulation/clip.h"
#include "edgevo/simulation/scene.h"

namespace edgevo::test {

/// Consistency of the estimated pose covariances with the true errors. The error is that of
/// T_frame_reference, the pose relative to the keyframe that the frame was tracked against: xi = log(T_est
/// T_true^-1), [v, w], lengths in metres by the scale of the run. The component along the translation, which
/// depends on the unit of length, is projected out in the metric of the estimated covariance. The normalised
/// square of the rest follows chi^2 with five degrees of freedom where the covariance is right.
struct Consistency {
  /// Number of frames that were evaluated.
  int frames = 0;
  /// Mean of the normalised square over five: 1 where the covariance is right.
  double mean_ratio = 0;
  /// Share of the frames within the two-sided 95 % bounds of chi^2_5.
  double inside = 0;
};

struct RunAccuracy {
  Run run;
  Consistency consistency;
  TrajectoryEvaluation evaluation;
  /// Length of the true path over the frames with a pose, metres.
  double path_m = 0;
  /// ATE after Sim(3) alignment, percent of the path length.
  double ate_percent = 0;
  /// Largest |ln(local scale / scale of the run)| over windows of a tenth of the run or more.
  double scale_drift = 0;
  /// Number of input frames before the first one with a pose.
  int first_posed = -1;
  /// Share of the frames with a pose, 0 to 1, counted from the first one that has one.
  double completion = 0;
  /// CPU time of all stages, milliseconds per frame; printed, not asserted.
  double mean_cpu_ms = 0;
};

/// Runs the odometry over the whole source, synchronously, in the given pinhole, if any. Throws InputError as
/// the source does.
Run run_source(ImageSource& source, const OdometryParams& params = {}, uint64_t seed = 1,
               const std::optional<Pinhole>& working_pinhole = {});

/// The same with a gyro next to the camera, whose samples are in the order of their times.
Run run_source(ImageSource& source, const std::vector<GyroSample>& gyro, uint64_t seed);

/// Evaluates a run against ground truth. Throws InputError where fewer than three frames have a pose.
RunAccuracy measure(Run run, const Trajectory& truth);

/// Consistency of the pose covariances of all frames that are no keyframes.
Consistency pose_consistency(const Run& run, const Trajectory& truth, double metres_per_unit);

/// Seed 1, or seeds 1 to N where the environment variable EDGEVO_TEST_SEEDS is N: shows the spread of the
/// figures before a bound is set.
std::vector<uint64_t> test_seeds();

/// Runs over the clip with each of test_seeds(), writes the figures to stdout and passes them to `check`.
void for_each_seed(const std::shared_ptr<const Clip>& clip, const Trajectory& truth,
                   const std::function<void(const RunAccuracy&)>& check,
                   const std::optional<Pinhole>& working_pinhole = {});

/// Ground truth of frames begin to end - 1 of a scene.
Trajectory truth_of(const Scene& scene, int begin, int end);

std::ostream& operator<<(std::ostream& out, const RunAccuracy& figures);

}  // namespace edgevo::test
