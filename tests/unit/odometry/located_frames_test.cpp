// SPDX-License-Identifier: BSD-3-Clause
// A rendered run whose first frames are located in a map that was kept: here by the poses of an earlier run.
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <variant>

#include "edgevo/map/located_pose.h"
#include "edgevo/map/map_log.h"
#include "edgevo/odometry/odometry.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::sweep_camera;
using test::sweep_frame;

constexpr int kBegin = 20, kEnd = 70;
constexpr double kUnit = 3;  // of the kept map, in that of the earlier run

const edgevo::Run& earlier() {
  static const edgevo::Run run = test::run_sweep(kEnd);
  return run;
}

SE3 T_kept_cam(int frame) {
  const SE3 T = *earlier().frames[size_t(frame)].T_world_cam;
  return {T.rotation(), kUnit * T.translation()};
}

LocatedPose located(int frame) {
  LocatedPose pose;
  pose.T_world_cam = T_kept_cam(frame);
  pose.covariance = 1e-4 * Matrix6d::Identity();
  pose.median_depth = kUnit * earlier().frames[size_t(frame)].evidence.median_depth;
  return pose;
}

struct Located {
  edgevo::Run run;
  int first_map = -1;          // frame of the first pose that is not by itself
  std::set<NodeId> keyframes;  // that are places of the kept map
  std::string log;
};

// Frames from kBegin on, those from `from` on located. `on_schedule`: the map is made next to the frames,
// which come once the search has had time to take the ones before.
Located follow(int from, bool on_schedule = false) {
  int frame = kBegin;
  OdometryOptions options;
  options.map_log = std::make_shared<MapLog>();
  options.realtime = options.on_schedule = on_schedule;
  options.locate = [&](const FramePyramid&) {
    return frame >= from ? std::optional(located(frame)) : std::nullopt;
  };
  Located f;
  options.log = [&](const std::string& line) { f.log += line + "\n"; };
  OdometryParams params;
  params.edge_map.mode = "off";
  MapCursor cursor(options.map_log);
  Odometry odometry(sweep_camera(), params, options);
  for (; frame < kEnd; ++frame) {
    odometry.process(sweep_frame(frame));
    if (on_schedule && f.first_map < 0) std::this_thread::sleep_for(std::chrono::milliseconds(150));
    if (f.first_map < 0 && odometry.newest_pose().T_cam_map) f.first_map = frame;
  }
  odometry.close();
  for (const auto& event : cursor.read())
    if (const auto* added = std::get_if<ConstraintAdded>(event.get()))
      if (added->constraint.kind == ConstraintKind::kPlace && added->constraint.from == NodeId::world())
        f.keyframes.insert(added->constraint.to);
  f.run = odometry.finish();
  return f;
}

TEST(LocatedFrames, TheFirstMapWaitsForImagesThatMayBeLocated) {
  const Located never = follow(kEnd);
  EXPECT_GE(never.first_map, kBegin + kImagesToLocate - 1);
  EXPECT_LT(never.first_map, kBegin + 2 * kImagesToLocate);
  EXPECT_TRUE(never.keyframes.empty());
}

TEST(LocatedFrames, TheTurnBetweenThemTakesPartInTheFirstMotion) {
  EXPECT_NE(follow(kBegin).log.find("motion by a known turn"), std::string::npos);
  EXPECT_EQ(follow(kEnd).log.find("known turn"), std::string::npos);
}

TEST(LocatedFrames, AMapThatIsMadeNextToTheFramesBeginsByThem) {
  const Located f = follow(kBegin, true);
  EXPECT_NE(f.log.find("motion by a known turn"), std::string::npos) << f.log;
  const SE3 off = T_kept_cam(kEnd - 1).inverse() * *f.run.frames.back().T_world_cam;
  const double length = (T_kept_cam(kEnd - 1).translation() - T_kept_cam(kBegin).translation()).norm();
  EXPECT_LT(off.translation().norm(), 0.2 * length) << "by the unit that one view has";
  EXPECT_LT(off.angle(), 0.02);
}

TEST(LocatedFrames, KeyframesOfAYoungMapArePlacesOfTheKeptOne) {
  const Located f = follow(kBegin + 2);
  EXPECT_GE(f.keyframes.size(), 3u);
  int near = 0;
  const double length = (T_kept_cam(kEnd - 1).translation() - T_kept_cam(kBegin).translation()).norm();
  for (const FrameRecord& record : f.run.frames) {
    if (!record.T_world_cam) continue;
    const SE3 off = T_kept_cam(record.index).inverse() * *record.T_world_cam;
    near += off.translation().norm() < 0.03 * length && off.angle() < 0.01;
  }
  EXPECT_GE(near, kEnd - kBegin - 4);
}

TEST(LocatedFrames, AMapThatIsLocatedLateIsPlaced) {
  const Located f = follow(kBegin + kImagesToLocate + 6);
  EXPECT_LT(f.first_map, kBegin + kImagesToLocate + 6) << "the map was there before";
  EXPECT_GE(f.keyframes.size(), 1u);
  const SE3 off = T_kept_cam(kEnd - 1).inverse() * *f.run.frames.back().T_world_cam;
  const double length = (T_kept_cam(kEnd - 1).translation() - T_kept_cam(kBegin).translation()).norm();
  EXPECT_LT(off.translation().norm(), 0.05 * length);
  EXPECT_LT(off.angle(), 0.02);
}

}  // namespace
}  // namespace edgevo
