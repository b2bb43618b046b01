// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A window of keyframes of the sweep, for the tests of the window.
#include <cmath>
#include <memory>
#include <vector>

#include "edgevo/mapping/window.h"
#include "support/sweep_scene.h"

namespace edgevo::test {

constexpr int kFramesApart = 4;  // from one keyframe to the next

inline WindowParams seven_keyframes() {
  WindowParams p;
  p.keyframes = 7;
  return p;
}

inline Matrix6d tracking_covariance() { return 1e-5 * Matrix6d::Identity(); }

/// A map in its first segment, for a window on it.
struct OwnMap {
  std::shared_ptr<MapLog> log = std::make_shared<MapLog>();
  std::shared_ptr<Map> map = std::make_shared<Map>(Sweep::pinhole(), log);
};

/// A window with a map of its own.
struct OwnWindow : OwnMap, Window {
  explicit OwnWindow(const WindowParams& params)
      : Window(map.get(), Sweep::pinhole(), params, AssociationParams()) {
    map->begin_segment(0);
  }
};

/// `n` keyframes at their true poses, points not yet activated.
inline OwnWindow true_window(int n, double depth_noise, const WindowParams& params = seven_keyframes()) {
  OwnWindow window(params);
  Random random(17);
  for (int k = 0; k < n; ++k) window.add(true_keyframe(k, kFramesApart * k, depth_noise, &random));
  return window;
}

/// Median relative depth error of the active points.
inline double idepth_error(const Window& window) {
  std::vector<double> relative;
  for (const Keyframe& k : window.keyframes())
    for (const MapPoint& p : k.points)
      relative.push_back(std::abs(p.idepth / Sweep::idepth(k.frame_index, p.px) - 1));
  EXPECT_FALSE(relative.empty()) << "no active point";
  return median(relative);
}

/// Difference from the true pose; identity if the pose is true.
inline SE3 pose_error(const Keyframe& k) { return k.T_cam_world * sweep_pose(k.frame_index); }

}  // namespace edgevo::test
