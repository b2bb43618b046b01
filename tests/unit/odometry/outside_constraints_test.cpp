// SPDX-License-Identifier: BSD-3-Clause
// A rendered run about whose past others find out while it goes on.
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "edgevo/map/map_log.h"
#include "edgevo/map/run_builder.h"
#include "edgevo/odometry/odometry.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

using test::sweep_camera;
using test::sweep_frame;

constexpr int kRunFrames = 110, kFoundAt = 80;
constexpr double kAside = 0.05;  // in the unit of the map

// Keyframe `to` lies aside of where `from` has it.
Constraint aside(const edgevo::Run& run, int from, int to) {
  Constraint c;
  c.from = NodeId::keyframe(from), c.to = NodeId::keyframe(to);
  c.kind = ConstraintKind::kPlace;
  const SE3 T = run.keyframes[size_t(from)].T_world_cam.inverse() * run.keyframes[size_t(to)].T_world_cam;
  c.T_from_to.rigid = SE3(T.rotation(), T.translation() + Eigen::Vector3d(kAside, 0, 0));
  c.covariance = 1e-6 * Matrix7d::Identity();
  c.failure = Constraint::Failure{0.01, Matrix7d::Identity()};
  return c;
}

OdometryOptions followed() {
  OdometryOptions options;
  options.map_log = std::make_shared<MapLog>();
  return options;
}

struct Followed {
  std::vector<FrameRecord> live;
  edgevo::Run run;
  std::vector<std::shared_ptr<const MapEvent>> events;
};

Followed follow(const std::vector<Constraint>& found, bool is_withdrawn = false) {
  const OdometryOptions options = followed();
  MapCursor cursor(options.map_log);
  OdometryParams params;
  params.edge_map.mode = "off";
  Odometry odometry(sweep_camera(), params, options);
  Followed f;
  std::vector<int> ids;
  for (int k = 0; k < kRunFrames; ++k) {
    if (k == kFoundAt)
      for (const Constraint& c : found) ids.push_back(options.map_log->add_constraint(c));
    if (k == kFoundAt + 10 && is_withdrawn)
      for (const int id : ids) options.map_log->withdraw_constraint(id);
    f.live.push_back(odometry.process(sweep_frame(k)));
  }
  f.run = odometry.finish();
  f.events = cursor.read();
  return f;
}

class OutsideConstraints : public ::testing::Test {
 protected:
  static const Followed& plain() {
    static const Followed f = follow({});
    return f;
  }
};

double moved_by(const edgevo::Run& a, const edgevo::Run& b, size_t k) {
  return (a.keyframes[k].T_world_cam.translation() - b.keyframes[k].T_world_cam.translation()).norm();
}

TEST_F(OutsideConstraints, ThePastMovesAndLivePosesDoNot) {
  ASSERT_GT(plain().run.keyframes.size(), 14u);
  const Followed moved = follow({aside(plain().run, 1, 10)});
  for (size_t k = 0; k < size_t(kRunFrames); ++k) {
    const auto &a = plain().live[k].T_world_cam_live, &b = moved.live[k].T_world_cam_live;
    ASSERT_EQ(a.has_value(), b.has_value());
    EXPECT_LT((a.value_or(SE3()).matrix() - b.value_or(SE3()).matrix()).norm(), 1e-12) << k;
  }
  EXPECT_NEAR(moved_by(plain().run, moved.run, 10), kAside, 0.2 * kAside);
  EXPECT_LT(moved_by(plain().run, moved.run, 0), 1e-9);
  ASSERT_EQ(moved.run.constraints.size(), 1u);
  EXPECT_EQ(moved.run.constraints[0].kind, "place");
  EXPECT_TRUE(moved.run.constraints[0].holds);

  RunBuilder builder(sweep_camera().pinhole());
  for (const auto& event : moved.events) builder.apply(*event);
  const edgevo::Run again = builder.finish();
  for (size_t k = 0; k < again.keyframes.size(); ++k) EXPECT_EQ(moved_by(again, moved.run, k), 0) << k;
}

TEST_F(OutsideConstraints, WhatIsWithdrawnLeavesNothingBehind) {
  const Followed moved = follow({aside(plain().run, 1, 10)}, true);
  EXPECT_TRUE(moved.run.constraints.empty());
  for (size_t k = 0; k < moved.run.keyframes.size(); ++k)
    EXPECT_LT(moved_by(plain().run, moved.run, k), 1e-12) << k;
}

// Each follows the run by itself, states relations of what it has seen, and withdraws every second one.
TEST(ThreeProducers, AddAndWithdrawAtOnce) {
  OdometryOptions options = followed();
  options.realtime = true;
  std::atomic<bool> is_ended{false};
  std::atomic<int> kept{0};
  const auto produce = [&](int distance) {
    MapCursor cursor(options.map_log);
    std::vector<int> keyframes;
    for (bool is_last = false; !is_last;) {
      is_last = is_ended;
      for (const auto& event : cursor.read()) {
        const auto* added = std::get_if<KeyframeAdded>(event.get());
        if (!added) continue;
        keyframes.push_back(added->id);
        if (int(keyframes.size()) <= distance) continue;
        Constraint c;
        c.from = NodeId::keyframe(keyframes[keyframes.size() - 1 - size_t(distance)]);
        c.to = NodeId::keyframe(added->id);
        c.kind = ConstraintKind::kPlace;
        const int id = options.map_log->add_constraint(c);
        if (id % 2 == 0)
          options.map_log->withdraw_constraint(id);
        else
          ++kept;
      }
      std::this_thread::yield();
    }
  };
  std::vector<std::thread> producers;
  for (const int distance : {1, 2, 5}) producers.emplace_back(produce, distance);
  Odometry odometry(sweep_camera(), {}, options);
  for (int k = 0; k < kRunFrames; ++k) (void)odometry.process(sweep_frame(k));
  is_ended = true;
  for (std::thread& t : producers) t.join();
  const edgevo::Run run = odometry.finish();
  EXPECT_GT(kept, 5);
  EXPECT_EQ(int(run.constraints.size()), kept.load());
  std::set<int> frames;
  for (const FrameRecord& f : run.frames) frames.insert(f.index);
  EXPECT_EQ(frames.size(), size_t(kRunFrames));
}

}  // namespace
}  // namespace edgevo
