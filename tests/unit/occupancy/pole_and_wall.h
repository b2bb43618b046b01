// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A run with a known scene: a camera moves sideways past a thin pole in front of a wall of points.
#include "edgevo/core/records.h"

namespace edgevo::test {

inline Pinhole test_pinhole() { return {300, 300, 320, 240, 640, 480}; }

/// A world point as stored in its host keyframe.
inline EdgePoint edge_point(const Pinhole& pinhole, const SE3& T_world_cam, const Eigen::Vector3d& p_world,
                            double relative_sigma, int observations) {
  const Eigen::Vector3d p_cam = T_world_cam.inverse() * p_world;
  EdgePoint p;
  p.px = pinhole.project(p_cam).cast<float>();
  p.normal = {1, 0};
  p.idepth = float(1 / p_cam.z());
  p.idepth_sigma = float(relative_sigma / p_cam.z());
  p.observations = observations;
  p.gray = 128;
  return p;
}

/// A world line from a to b as stored in its host keyframe.
inline EdgeLine edge_line(const Pinhole& pinhole, const SE3& T_world_cam, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, int vertices) {
  EdgeLine line;
  line.keyframes = 3;
  line.is_straight = true;
  for (int i = 0; i < vertices; ++i) {
    const EdgePoint p = edge_point(pinhole, T_world_cam, a + (b - a) * i / (vertices - 1), 0.005, 3);
    line.vertices.push_back({p.px, p.idepth, p.idepth_sigma, 40, 200});
  }
  return line;
}

struct PoleAndWall {
  Run run;
  /// World points of the pole, at depth 5, hosted by the first keyframe.
  std::vector<Eigen::Vector3d> pole;
  /// World points of the wall, at depth 10, hosted by every keyframe.
  std::vector<Eigen::Vector3d> wall;
};

/// The run with `keyframes` cameras, 0.1 apart along x. Points of the pole have `pole_observations`
/// observations.
inline PoleAndWall pole_and_wall(int keyframes, int pole_observations) {
  PoleAndWall scene;
  scene.run.pinhole = test_pinhole();
  // Points are at the centres of voxels of 0.1, so that rounding cannot move them to the next voxel.
  for (int y = -10; y < 10; ++y) scene.pole.emplace_back(0.05, 0.1 * y + 0.05, 5.05);
  for (int x = -40; x < 40; ++x)
    for (int y = -20; y < 20; ++y) scene.wall.emplace_back(0.1 * x + 0.05, 0.1 * y + 0.05, 10.05);
  for (int k = 0; k < keyframes; ++k) {
    KeyframeRecord keyframe;
    keyframe.frame_index = k;
    keyframe.T_world_cam = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.1 * k, 0, 0));
    for (const auto& p : scene.wall)
      keyframe.points.push_back(edge_point(scene.run.pinhole, keyframe.T_world_cam, p, 0.01, 4));
    if (k == 0)
      for (const auto& p : scene.pole)
        keyframe.points.push_back(
            edge_point(scene.run.pinhole, keyframe.T_world_cam, p, 0.02, pole_observations));
    scene.run.keyframes.push_back(keyframe);
  }
  return scene;
}

}  // namespace edgevo::test
