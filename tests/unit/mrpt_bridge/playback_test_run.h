// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A small run with known world points, for the tests of the writers.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "edgevo/core/records.h"
#include "support/temp_folder.h"

namespace edgevo::test {

inline EdgePoint edge_point(const Pinhole& pinhole, const SE3& T_world_cam, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p_cam = T_world_cam.inverse() * p_world;
  EdgePoint p;
  p.px = pinhole.project(p_cam).cast<float>();
  p.normal = {1, 0};
  p.idepth = float(1 / p_cam.z());
  p.idepth_sigma = 0.01f * p.idepth;
  p.observations = 4;
  p.gray = 99;
  return p;
}

/// The world points hosted by every keyframe of small_run(), camera axes.
inline std::vector<Eigen::Vector3d> world_points() {
  return {{-1.04, -0.53, 6.07}, {0.5, 0.25, 7}, {1.5, -1, 9}, {-2, 1, 11}, {0.02, 0.03, 13}};
}

/// A run of eight frames, 0.1 s apart, that moves forward and turns; frame 3 is lost; keyframes 0, 2, 5.
inline Run small_run() {
  Run run;
  run.pinhole = {300, 300, 32, 24, 64, 48};
  for (int i = 0; i < 8; ++i) {
    FrameRecord frame;
    frame.index = i;
    frame.time.ticks = 16'000'000'000'000'000 + 1'000'000 * i;
    frame.state = i == 3 ? TrackingState::kLost : TrackingState::kTracking;
    frame.segment = 0;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d(0.1, 1, 0.2).normalized()));
    if (i != 3) frame.T_world_cam = SE3(turn, Eigen::Vector3d(0.02 * i, -0.01 * i, 0.3 * i));
    frame.covariance = 1e-4 * Matrix6d::Identity();
    if (i == 0 || i == 2 || i == 5) {
      KeyframeRecord keyframe;
      keyframe.frame_index = i;
      keyframe.time = frame.time;
      keyframe.T_world_cam = *frame.T_world_cam;
      for (const auto& p : world_points())
        keyframe.points.push_back(edge_point(run.pinhole, keyframe.T_world_cam, p));
      frame.is_keyframe = true;
      run.keyframes.push_back(keyframe);
    }
    run.frames.push_back(frame);
  }
  return run;
}

/// A temporary folder for the running test; removed at the end.
class FolderTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  test::TempFolder temp_;
  const std::filesystem::path folder_ = temp_.path();
};

}  // namespace edgevo::test
