// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sequences for the tests of the odometry: the sweep through the hollow scene, with blacked-out intervals if
// requested.
#include <Eigen/Geometry>
#include <vector>

#include "edgevo/odometry/odometry.h"
#include "support/hollow_scene.h"

namespace edgevo::test {

/// Frames 0..n-1 of the sweep with sensor noise; images are rendered once for all tests of the program.
inline Frame sweep_frame(int k) {
  static const HollowScene scene;
  static std::vector<GrayImage> images;
  for (int i = int(images.size()); i <= k; ++i)
    images.push_back(scene.render(sweep_pose(i), 1, 0, 1.5, uint64_t(i + 1)));
  return {k, Timestamp::from_seconds(0.05 * k), images[size_t(k)]};
}

inline Camera sweep_camera() { return HollowScene().camera; }

inline Frame black(Frame frame) {
  std::fill(frame.image.pixels.begin(), frame.image.pixels.end(), uint8_t(0));
  return frame;
}

/// Runs frames 0..n-1, those in [black_begin, black_end) black.
inline Run run_sweep(int n, const OdometryOptions& options = {}, int black_begin = 0, int black_end = 0,
                     const OdometryParams& params = {}) {
  Odometry odometry(sweep_camera(), params, options);
  for (int k = 0; k < n; ++k)
    odometry.process(k >= black_begin && k < black_end ? black(sweep_frame(k)) : sweep_frame(k));
  return odometry.finish();
}

struct TrajectoryError {
  int poses = 0;
  /// Rms position error after a similarity fit, in the unit of the truth.
  double rmse = 0;
  /// Length in the truth over length in the estimate.
  double scale = 0;
  /// Length of the true path between the poses used.
  double length = 0;
};

/// Error of the final poses of frames begin <= index < end against `truth`(index), position only.
template <class Truth>
TrajectoryError trajectory_error(const Run& run, int begin, int end, const Truth& truth) {
  TrajectoryError e;
  std::vector<Eigen::Vector3d> a, b;
  for (const FrameRecord& f : run.frames) {
    if (f.index < begin || f.index >= end || !f.T_world_cam) continue;
    a.push_back(f.T_world_cam->translation());
    b.push_back(truth(f.index).translation());
    if (b.size() > 1) e.length += (b[b.size() - 1] - b[b.size() - 2]).norm();
  }
  e.poses = int(a.size());
  if (a.size() < 3) return e;
  const auto matrix = [](const std::vector<Eigen::Vector3d>& v) {
    Eigen::Matrix3Xd m(3, long(v.size()));
    for (size_t i = 0; i < v.size(); ++i) m.col(long(i)) = v[i];
    return m;
  };
  const Eigen::Matrix3Xd from = matrix(a), to = matrix(b);
  const Eigen::Matrix4d S = Eigen::umeyama(from, to, true);
  e.scale = S.topLeftCorner<3, 3>().col(0).norm();
  e.rmse =
      std::sqrt(((S.topLeftCorner<3, 3>() * from).colwise() + S.topRightCorner<3, 1>() - to).squaredNorm() /
                double(a.size()));
  return e;
}

}  // namespace edgevo::test
