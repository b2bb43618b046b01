// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A made run next to a true trajectory, for the evaluation of frames: what the program says and where it
// believes to be is known for every frame.
#include <cmath>
#include <functional>
#include <vector>

#include "edgevo/core/random.h"
#include "edgevo/frame_evaluation/evaluate_frames.h"
#include "support/synthetic_trajectory.h"

namespace edgevo::test {

/// A run as the program reported it, and the truth. The unit of the run is `kUnitsPerMetre`, the median depth
/// 10 m: 2 % of it are 0.2 m.
struct MadeRun {
  static constexpr double kUnitsPerMetre = 0.4;
  Trajectory truth;
  std::vector<ReportedFrame> reported;
};

/// A run that is right in every frame and says so. `factor` multiplies the length of the step that follows a
/// frame, `turn` is added to its rotation about y, radians.
inline MadeRun made_run(const Trajectory& truth, const std::function<double(int)>& factor = {},
                        const std::function<double(int)>& turn = {}) {
  MadeRun made{truth, {}};
  SE3 pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX())), Eigen::Vector3d(3, -1, 2));
  for (int i = 0; i < int(truth.poses.size()); ++i) {
    if (i > 0) {
      const SE3 step = truth.poses[size_t(i) - 1].T_world_cam.inverse() * truth.poses[size_t(i)].T_world_cam;
      const double length = MadeRun::kUnitsPerMetre * (factor ? factor(i - 1) : 1);
      const Eigen::Quaterniond more(Eigen::AngleAxisd(turn ? turn(i - 1) : 0, Eigen::Vector3d::UnitY()));
      pose = pose * SE3(more * step.rotation(), length * step.translation());
    }
    ReportedFrame frame;
    frame.index = i, frame.time = truth.poses[size_t(i)].time, frame.state = TrackingState::kTracking;
    frame.segment = 0, frame.median_depth = 10 * MadeRun::kUnitsPerMetre, frame.T_world_cam = pose;
    made.reported.push_back(frame);
  }
  return made;
}

inline int wrong_frames(const FrameEvaluation& evaluation) {
  int count = 0;
  for (const FrameError& frame : evaluation.frames) count += frame.is_evaluated && frame.wrong;
  return count;
}

inline int evaluated_frames(const FrameEvaluation& evaluation) {
  int count = 0;
  for (const FrameError& frame : evaluation.frames) count += frame.is_evaluated;
  return count;
}

}  // namespace edgevo::test
