// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A synthetic trajectory with one pose per frame, and its modifications for tests.
#include <cmath>
#include <string>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/core/random.h"
#include "edgevo/core/sim3.h"
#include "edgevo/evaluation/evaluate.h"
#include "edgevo/evaluation/time_matching.h"

namespace edgevo::test {

/// A winding trajectory: frame i at i * 0.1 s, about `step_m` a frame, turning and climbing gently.
inline Trajectory winding_drive(int frames, double step_m = 1.0) {
  Trajectory t{"drive.txt", TrajectoryFormat::kTum, {}};
  SE3 pose;
  for (int i = 0; i < frames; ++i) {
    t.poses.push_back({Timestamp{i * Timestamp::kTicksPerSecond / 10}, pose});
    Vector6d xi;
    xi << 0, 0.02 * step_m * std::sin(0.05 * i), step_m, 0.002 * std::sin(0.1 * i),
        0.03 * std::sin(0.021 * i), 0;
    pose = pose * SE3::exp(xi);
  }
  return t;
}

inline Trajectory straight_drive(int frames, double step_m = 1.0) {
  Trajectory t{"straight.txt", TrajectoryFormat::kTum, {}};
  for (int i = 0; i < frames; ++i)
    t.poses.push_back({Timestamp{i * Timestamp::kTicksPerSecond / 10},
                       SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, step_m * i))});
  return t;
}

/// Estimate in another world frame and unit: T_est = S^-1 applied to the truth.
inline Trajectory seen_through(const Sim3& S, Trajectory t) {
  t.path = "estimate.txt";
  const Sim3 inverse = S.inverse();
  for (StampedPose& p : t.poses) p.T_world_cam = inverse.apply(p.T_world_cam);
  return t;
}

inline Trajectory with_noise(Trajectory t, double sigma, uint64_t seed) {
  Random random(seed);
  for (StampedPose& p : t.poses) {
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    p.T_world_cam = SE3(p.T_world_cam.rotation(), p.T_world_cam.translation() + sigma * noise);
  }
  return t;
}

inline Sim3 some_similarity() {
  Vector6d xi;
  xi << 3, -2, 7, 0.4, -0.9, 0.3;
  return {2.5, SE3::exp(xi)};
}

inline InputFrames frames_of(const Trajectory& t) {
  InputFrames input{{}, "test"};
  for (const StampedPose& p : t.poses) input.times.push_back(p.time);
  return input;
}

/// Message of the InputError that `action` throws; empty if it throws none.
template <class Action>
std::string input_error_of(Action&& action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

}  // namespace edgevo::test
