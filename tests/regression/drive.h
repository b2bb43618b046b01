#pragma once
// One run of the odometry over a source, measured against ground truth: what the accuracy tests look at.
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

/// The told covariance of poses against their true error. The error is that of T_frame_reference against the
/// keyframe a frame was tracked against: xi = log(T_est T_true^-1), [v, w], lengths brought to metres by the
/// scale of the run. Its part along the translation, which a wrong unit of length makes, is taken out with
/// the told covariance as metric, so that the normalised square of the rest follows chi^2 with five degrees
/// of freedom where the covariance is right.
struct Consistency {
  int frames = 0;
  double mean_ratio = 0;  ///< mean of the normalised square over five: 1 where the covariance is right
  double inside = 0;      ///< share of the frames within the two-sided 95 % bounds of chi^2_5
};

struct DriveFigures {
  Run run;
  Consistency consistency;
  TrajectoryEvaluation evaluation;
  double path_m = 0;       ///< of the ground truth over the frames with a pose
  double ate_percent = 0;  ///< ATE after Sim(3), of the path
  double scale_drift =
      0;  ///< largest |ln(local scale / scale of the run)| over windows of a tenth of the run or more
  int first_posed = -1;    ///< number of input frames before the first one with a pose
  double completion = 0;   ///< share of the frames with a pose
  double mean_cpu_ms = 0;  ///< all stages, CPU milliseconds a frame; told, not asserted
};

/// Feeds the whole source, synchronously. Throws InputError as the source does.
Run drive(ImageSource& source, const OdometryParams& params = {}, uint64_t seed = 1);

/// Throws InputError where fewer than three frames have a pose.
DriveFigures measure(Run run, const Trajectory& truth);

/// Of the frames that are no keyframes themselves.
Consistency pose_consistency(const Run& run, const Trajectory& truth, double metres_per_unit);

/// 1; or 1 to N where the environment says EDGEVO_TEST_SEEDS=N: to see how far the figures spread before a
/// bound is set.
std::vector<uint64_t> test_seeds();

/// Drives over the clip with each of test_seeds(), writes the figures to stdout and hands them to `look`.
void for_each_seed(const std::shared_ptr<const Clip>& clip, const Trajectory& truth,
                   const std::function<void(const DriveFigures&)>& look);

/// Final poses of the frames that have one.
Trajectory trajectory_of(const Run& run);
/// Of frames begin .. end-1 of a scene.
Trajectory truth_of(const Scene& scene, int begin, int end);

std::ostream& operator<<(std::ostream& out, const DriveFigures& figures);

}  // namespace edgevo::test
