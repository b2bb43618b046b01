// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A made-up drive over flat ground: a winding path, points on the ground and above it, a unit that grows
// along the path.
#include <cmath>
#include <random>

#include "edgevo/core/records.h"

namespace edgevo::test {

struct GroundDrive {
  int frames = 300;
  /// Metres.
  double camera_height = 1.65;
  double metres_per_unit_begin = 2, metres_per_unit_end = 2;
  /// Pitch of the camera on the vehicle, radians.
  double pitch = 0;
  /// Share of the points on the ground; the others are above it, as cars are.
  double ground_share = 0.6;
  /// Relative standard deviation of the depths.
  double relative_noise = 0.02;
  unsigned seed = 1;
  /// The speed changes by this share of half a metre a frame, to and fro, within 9 s.
  double speed_changes = 0;
};

struct MadeRun {
  Run run;
  /// Poses in metres, as run.frames.
  std::vector<SE3> truth;
};

inline double unit_at(const GroundDrive& drive, int i) {
  const double share = double(i) / (drive.frames - 1);
  return drive.metres_per_unit_begin + share * (drive.metres_per_unit_end - drive.metres_per_unit_begin);
}

/// True poses in metres: half a metre a frame, the heading sways by half a radian; the camera is pitched on
/// its vehicle.
inline std::vector<SE3> true_poses(const GroundDrive& drive) {
  std::vector<SE3> poses;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int i = 0; i < drive.frames; ++i) {
    const Eigen::AngleAxisd heading(0.5 * std::sin(0.02 * i), Eigen::Vector3d::UnitY());
    const Eigen::AngleAxisd pitch(drive.pitch, Eigen::Vector3d::UnitX());
    poses.emplace_back(Eigen::Quaterniond(heading * pitch), position);
    position += heading * Eigen::Vector3d(0, 0, 0.5 + 0.5 * drive.speed_changes * std::sin(0.07 * i));
  }
  return poses;
}

/// The run that a monocular odometry would make of it: lengths divided by a unit that changes along the path.
inline MadeRun drive_over_ground(const GroundDrive& drive) {
  MadeRun made;
  made.truth = true_poses(drive);
  made.run.pinhole = {700, 700, 600, 200, 1200, 400};
  std::mt19937 random(drive.seed);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int i = 0; i < drive.frames; ++i) {
    const SE3& truth = made.truth[size_t(i)];
    if (i > 0)
      position += (truth.translation() - made.truth[size_t(i) - 1].translation()) / unit_at(drive, i);
    FrameRecord frame;
    frame.index = i;
    frame.time = Timestamp::from_seconds(100 + 0.1 * i);
    frame.segment = 0;
    frame.state = TrackingState::kTracking;
    frame.T_world_cam = frame.T_world_cam_live = SE3(truth.rotation(), position);
    made.run.frames.push_back(frame);
    if (i % 2 != 0) continue;
    KeyframeRecord keyframe;
    keyframe.frame_index = i;
    keyframe.time = frame.time;
    keyframe.T_world_cam = *frame.T_world_cam;
    const Eigen::Quaterniond level =
        truth.rotation() * Eigen::AngleAxisd(-drive.pitch, Eigen::Vector3d::UnitX());
    for (int k = 0; k < 12; ++k) {
      const double y =
          uniform(0, 1) < drive.ground_share ? drive.camera_height : uniform(0, drive.camera_height);
      const Eigen::Vector3d p_level(uniform(-4, 4), y, uniform(5, 15));
      const Eigen::Vector3d p_cam = truth.rotation().inverse() * (level * p_level) / unit_at(drive, i);
      EdgePoint point;
      point.px = made.run.pinhole.project(p_cam).cast<float>();
      point.normal = {0, 1};
      point.idepth = float((1 + drive.relative_noise * uniform(-1.7, 1.7)) / p_cam.z());
      point.idepth_sigma = float(drive.relative_noise / p_cam.z());
      point.observations = 4;
      keyframe.points.push_back(point);
    }
    made.run.keyframes.push_back(keyframe);
  }
  return made;
}

/// Length of the path through the frames' final poses.
inline double length_of(const Run& run) {
  double length = 0;
  for (size_t i = 1; i < run.frames.size(); ++i)
    length +=
        (run.frames[i].T_world_cam->translation() - run.frames[i - 1].T_world_cam->translation()).norm();
  return length;
}

inline double largest_error(const Run& run, const std::vector<SE3>& truth) {
  double largest = 0;
  for (size_t i = 0; i < truth.size(); ++i)
    largest = std::max(largest, (run.frames[i].T_world_cam->translation() - truth[i].translation()).norm());
  return largest;
}

}  // namespace edgevo::test
