// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A synthetic run, made without odometry: a camera moving along a corridor of edges, with a lost interval and
// hence two segments. For the tests of outputs.
#include <cmath>
#include <vector>

#include "edgevo/core/image.h"
#include "edgevo/core/random.h"
#include "edgevo/core/records.h"

namespace edgevo::test {

struct SyntheticRun {
  Run run;
  Camera camera;
};

/// An image with some structure, different for each frame.
inline Frame synthetic_frame(const Camera& camera, const FrameRecord& record) {
  Frame frame;
  frame.index = record.index;
  frame.time = record.time;
  frame.image.width = camera.pinhole().width;
  frame.image.height = camera.pinhole().height;
  for (int y = 0; y < frame.image.height; ++y)
    for (int x = 0; x < frame.image.width; ++x)
      frame.image.pixels.push_back(uint8_t((x * x + 3 * y + 7 * record.index) >> 3));
  return frame;
}

/// Points on the two walls, floor and ceiling of a corridor 4 wide and 3 high, seen from `T_world_cam`.
inline std::vector<EdgePoint> corridor_points(const Pinhole& pinhole, const SE3& T_world_cam, int count,
                                              Random* random) {
  std::vector<EdgePoint> points;
  while (int(points.size()) < count) {
    const double along = T_world_cam.translation().z() + random->uniform(2, 12);
    const double across = random->uniform(-1, 1);
    const bool wall = random->below(2) == 0;
    const double side = random->below(2) == 0 ? 1 : -1;
    const Eigen::Vector3d p_world = wall ? Eigen::Vector3d(2 * side, 1.5 * across, along)
                                         : Eigen::Vector3d(2 * across, 1.5 * side, along);
    const Eigen::Vector3d p_cam = T_world_cam.inverse() * p_world;
    if (p_cam.z() < 0.5 || !pinhole.contains(pinhole.project(p_cam))) continue;
    EdgePoint p;
    p.px = pinhole.project(p_cam).cast<float>();
    p.normal = {1, 0};
    p.idepth = float(1 / p_cam.z());
    p.idepth_sigma = p.idepth * float(random->uniform(0.005, 0.2));
    p.observations = 1 + random->below(6);
    p.gray = uint8_t(random->below(256));
    points.push_back(p);
  }
  return points;
}

/// `frames` frames, every third a keyframe with `points` points. Frames 20 to 24 are lost; the first four are
/// filled in after the bootstrap and have no live pose. The evidence is complete.
inline SyntheticRun synthetic_run(int frames = 45, int points = 400) {
  SyntheticRun made;
  Run& run = made.run;
  run.pinhole = {260, 260, 159.5, 119.5, 320, 240};
  made.camera = {run.pinhole, {-0.05, 0.01, 0, 0, 0}};
  Random random(11);
  for (int i = 0; i < frames; ++i) {
    FrameRecord frame;
    frame.index = i;
    frame.time.ticks = 16'700'000'000'000'000 + 1'000'000 * i;
    const bool lost = i >= 20 && i < 25;
    frame.state = lost    ? TrackingState::kLost
                  : i < 4 ? TrackingState::kBootstrapping
                          : TrackingState::kTracking;
    frame.segment = lost ? -1 : i < 20 ? 0 : 1;
    frame.evidence.edges = 1000 + i;
    frame.evidence.saturated_share = 0.01;
    frame.evidence.edge_blur = 0.9;
    frame.stage_ms = {{"edges", 4 + 0.1 * i}, {"alignment", 2.0}};
    if (lost) {
      frame.note = "lost: 3 of 400 points aligned, 120 needed";
    } else {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.1 * std::sin(0.2 * i), Eigen::Vector3d::UnitY()));
      frame.T_world_cam = SE3(turn, Eigen::Vector3d(0.3 * std::sin(0.1 * i), 0, 0.2 * i));
      if (i >= 4)
        frame.T_world_cam_live = SE3(turn, frame.T_world_cam->translation() + Eigen::Vector3d(0.001, 0, 0));
      frame.evidence.inlier_share = 0.8;
      frame.evidence.residual_px = 0.5;
      frame.evidence.visible_points = points - i;
      frame.evidence.matched_points = points - 2 * i;
      frame.evidence.pose_sigmas = {1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4};
      if (i > 30) frame.evidence.step_sigmas = 0.5;
      frame.evidence.known_points = points;
      frame.evidence.lacking_share = 0.2;
      frame.evidence.view_share = 0.6;
      frame.evidence.median_depth = 5;
      frame.covariance = 1e-5 * Matrix6d::Identity();
    }
    if (!lost && i % 3 == 0) {
      KeyframeRecord keyframe;
      keyframe.frame_index = i;
      keyframe.time = frame.time;
      keyframe.segment = frame.segment;
      keyframe.T_world_cam = *frame.T_world_cam;
      keyframe.points = corridor_points(run.pinhole, keyframe.T_world_cam, points, &random);
      frame.is_keyframe = true;
      frame.keyframe_reason = KeyframeReason::kViewLeaves;
      frame.reference_keyframe = int(run.keyframes.size());
      frame.stage_ms.emplace_back("ba", 20.0);
      frame.evidence.adjustment = AdjustmentEvidence{1.25, 0.7, 2000, 700, 400};
      run.keyframes.push_back(keyframe);
    }
    run.frames.push_back(frame);
  }
  return made;
}

}  // namespace edgevo::test
