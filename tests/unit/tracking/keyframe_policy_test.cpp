// SPDX-License-Identifier: BSD-3-Clause
// When a frame becomes a keyframe.
#include "edgevo/tracking/keyframe_policy.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

// Points on a grid of pixels, at depths of 5 to 9.
ReferenceCloud grid_cloud(const Pinhole& camera) {
  ReferenceCloud cloud;
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 16; ++column) {
      const Eigen::Vector2d px((column + 0.5) * camera.width / 16, (row + 0.5) * camera.height / 12);
      CloudPoint p;
      p.ray = camera.ray(px);
      p.px = px.cast<float>();
      p.normal = Eigen::Vector2f::UnitX();
      p.idepth = 1.0 / (5 + (row + column) % 5);
      cloud.points.push_back(p);
    }
  return cloud;
}

constexpr int kLong = 1000;  // frames since the last keyframe

// What the criteria evaluate, and which one calls; flows at the width of these images, which is the reference
// width.
struct Seen : KeyframeView {
  std::string reason;
  bool needed = false;
};

class KeyframeReasons : public ::testing::Test {
 protected:
  Seen decide(const SE3& T_cam_ref, int frames = 1) const {
    return decide(camera, grid_cloud(camera), T_cam_ref, frames);
  }
  Seen decide(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref, int frames) const {
    Seen seen{look_at_keyframe(pinhole, cloud, T_cam_ref, frames), "", false};
    seen.reason = to_string(reason_for_keyframe(seen, params));
    seen.needed = !seen.reason.empty();
    return seen;
  }
  static SE3 move(double x, double y, double z, double turn = 0) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY())), Eigen::Vector3d(x, y, z)};
  }

  Pinhole camera{720, 720, 620, 187.5, 1241, 376};
  KeyframeParams params;
};

TEST_F(KeyframeReasons, NoneAtAStandstill) {
  const Seen d = decide(SE3(), kLong);
  EXPECT_FALSE(d.needed);
  EXPECT_EQ(d.flow_px, 0);
  EXPECT_EQ(d.view_share, 1);
}

TEST_F(KeyframeReasons, InPureRotationOneOnlyWhereTheSceneLeavesTheView) {
  for (double turn : {0.02, 0.1, 0.3, 0.5, 0.8, 2.0}) {
    const Seen d = decide(move(0, 0, 0, turn), kLong);
    EXPECT_EQ(d.reason, d.view_share < params.min_turn_share ? "rotation" : "") << turn;
    EXPECT_EQ(d.flow_px, 0);
  }
  EXPECT_GT(decide(move(0, 0, 0, 0.1)).view_share, params.min_turn_share);
  EXPECT_LT(decide(move(0, 0, 0, 0.8)).view_share, params.min_turn_share);
}

TEST_F(KeyframeReasons, NoneForAShakeBelowTheSmallestFlow) {
  const Seen d = decide(move(0.02, 0, 0), kLong);
  EXPECT_GT(d.flow_px, 0);
  EXPECT_LT(d.flow_px, params.min_flow_px);
  EXPECT_FALSE(d.needed);
}

TEST_F(KeyframeReasons, ForwardMotionMakesOneAtOnce) {
  EXPECT_FALSE(decide(move(0, 0, -0.2)).needed);
  const Seen d = decide(move(0, 0, -1.2));
  EXPECT_GT(d.flow_px, params.flow_px);
  EXPECT_EQ(d.reason, "parallax");
}

// Driving in, near points leave the view; backing away, as many enter it that the cloud does not know.
TEST_F(KeyframeReasons, TheFlowIsTheSameInBothDirections) {
  for (const SE3& T : {move(0, 0, 0.8), move(0.1, -0.05, -0.4, 0.05), move(0.2, 0, 0.1, 0.3)}) {
    const Seen out = decide(T), back = decide(T.inverse());
    EXPECT_NEAR(out.flow_px, back.flow_px, 1e-9);
  }
  EXPECT_EQ(decide(move(0, 0, 1.5)).view_share, 1) << "all that the cloud knows stays in view";
}

// The nearest points of the scene come into view: the next keyframe is needed sooner than when going forward,
// but not at each step.
TEST_F(KeyframeReasons, BackingAwayMakesOneSooner) {
  const auto flow_at_the_next = [&](const Eigen::Vector3d& direction) {
    Seen d;
    for (double path = 0.02; path < 3 && !d.needed; path += 0.02) {
      const Eigen::Vector3d t = path * direction;
      d = decide(move(t.x(), t.y(), t.z()), kLong / 10);
    }
    return d.flow_px;
  };
  EXPECT_NEAR(flow_at_the_next(-Eigen::Vector3d::UnitZ()), params.flow_px, 2);
  EXPECT_NEAR(flow_at_the_next(Eigen::Vector3d::UnitX()), params.flow_px, 4);
  EXPECT_LT(flow_at_the_next(Eigen::Vector3d::UnitZ()), 0.8 * params.flow_px);
  EXPECT_GT(flow_at_the_next(Eigen::Vector3d::UnitZ()), 0.45 * params.flow_px);
  params.shorten_in_expanding_view = false;
  EXPECT_NEAR(flow_at_the_next(Eigen::Vector3d::UnitZ()), params.flow_px, 2);
}

TEST_F(KeyframeReasons, SidewaysFlowIsThatOfTheDepths) {
  // Rms over the points of f t / z, exact since a sideways motion does not change z.
  const ReferenceCloud cloud = grid_cloud(camera);
  double square = 0;
  for (const CloudPoint& p : cloud.points)
    square += std::pow(camera.fx * 0.1 * p.idepth, 2) / double(cloud.points.size());
  EXPECT_NEAR(decide(move(0.1, 0, 0)).flow_px, std::sqrt(square), 1e-9);
}

TEST_F(KeyframeReasons, SlowMotionMakesOneAfterSomeFrames) {
  const SE3 slow = move(0.06, 0, 0);
  EXPECT_FALSE(decide(slow, params.max_frames - 1).needed);
  EXPECT_EQ(decide(slow, params.max_frames).reason, "long since");
}

TEST_F(KeyframeReasons, TurningAwayWithSomeMotionMakesOne) {
  const Seen away = decide(move(0.06, 0, 0, 0.5));
  EXPECT_LT(away.view_share, params.min_view_share);
  EXPECT_TRUE(away.needed);
  EXPECT_FALSE(decide(move(0.06, 0, 0, 0.02)).needed);
}

// A fast turn: enough is still in view, but not in the next frame. A turn that took several frames continues
// more slowly.
TEST_F(KeyframeReasons, TurningAwayFastMakesOneBeforeTooLittleIsInView) {
  const SE3 turning = move(0.06, 0, 0, 0.25);
  const Seen d = decide(turning, 1);
  ASSERT_GT(d.view_share, params.min_view_share);
  ASSERT_LT(1 - 2 * (1 - d.view_share), params.min_view_share);
  EXPECT_EQ(d.reason, "view leaves");
  EXPECT_FALSE(decide(turning, 10).needed);
}

// An even faster turn leaves the map behind within a few frames: each one is a keyframe.
TEST_F(KeyframeReasons, EachFrameOfAFastTurnMakesOne) {
  params.min_view_share = 0.7;
  const SE3 turning = move(0.06, 0, 0, 0.12);
  const Seen d = decide(turning, 1);
  ASSERT_GT(1 - 2 * (1 - d.view_share), params.min_view_share) << "the next frame would see enough";
  ASSERT_GT(1 - d.view_share, params.max_view_loss);
  EXPECT_EQ(d.reason, "fast turn");
  EXPECT_FALSE(decide(turning, 2).needed) << "half as fast";
  params.max_view_loss = 1;
  EXPECT_FALSE(decide(turning, 1).needed);
}

TEST_F(KeyframeReasons, ScalesWithTheWidthOfTheImage) {
  const Pinhole half{360, 360, 310, 93.75, 621, 188};
  for (double t : {0.05, 0.15, 0.17, 0.19, 0.21, 0.4}) {
    const Seen at_half = decide(half, grid_cloud(half), move(t, 0, 0), 1);
    EXPECT_EQ(at_half.needed, decide(move(t, 0, 0)).needed) << t;
  }
}

TEST_F(KeyframeReasons, NoneWithoutPoints) {
  EXPECT_FALSE(decide(camera, ReferenceCloud(), move(1, 0, 0), kLong).needed);
}

TEST_F(KeyframeReasons, NoneIfAllPointsAreBehindTheCamera) {
  const Seen d = decide(move(0, 0, -50), kLong);
  EXPECT_FALSE(d.needed);
  EXPECT_EQ(d.flow_px, 0);
}

// Keyframes 0 to 4, each one metre to the right of the one before; the reference is number 4.
Reference row_of_keyframes(const Pinhole& camera) {
  Reference reference;
  reference.keyframe_id = 4;
  for (int id = 0; id < 5; ++id)
    reference.T_keyframe_world[id] = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-id, 0, 0));
  reference.T_ref_world = reference.T_keyframe_world[4];
  reference.cloud = grid_cloud(camera);
  return reference;
}

TEST_F(KeyframeReasons, TheNearestKeyframeIsTheOneAtTheCamera) {
  const Reference reference = row_of_keyframes(camera);
  params.min_view_share = 0.3;
  for (const double back : {0.0, 0.9, 1.1, 2.0}) {
    const NearestKeyframe nearest = find_nearest_keyframe(camera, reference, move(back, 0, 0), params);
    EXPECT_EQ(nearest.id, 4 - int(std::lround(back))) << back;
    EXPECT_NEAR(nearest.flow_px, 720 * std::abs(back - std::round(back)) / 7, 15) << back;
  }
}

TEST_F(KeyframeReasons, AKeyframeWithAnotherViewIsNotNear) {
  Reference reference = row_of_keyframes(camera);
  reference.T_keyframe_world[2] = move(0, 0, 0, 2.0) * reference.T_keyframe_world[2];
  params.min_view_share = 0.3;
  EXPECT_NE(find_nearest_keyframe(camera, reference, move(2, 0, 0), params).id, 2);
}

TEST_F(KeyframeReasons, BackRequiresHalfTheFlowAndALeftReference) {
  EXPECT_TRUE(is_back({2, 3.0, 10.0}, 4, params));
  EXPECT_FALSE(is_back({2, 3.0, 10.0}, 2, params)) << "it is the reference";
  EXPECT_FALSE(is_back({2, 3.0, 5.0}, 4, params)) << "hardly nearer";
  EXPECT_FALSE(is_back({2, 0.1, 1.0}, 4, params)) << "a standstill";
  EXPECT_FALSE(is_back({2, 80.0, 12000.0}, 4, params)) << "a jump, away from all";
  EXPECT_FALSE(is_back(NearestKeyframe{-1, 0, 10.0}, 4, params)) << "there is none";
}

// Nearest and reference are measured in the same way: at the reference, it is the nearest, and both flows are
// equal.
TEST_F(KeyframeReasons, TheFlowOfTheReferenceIsMeasuredAsThatOfTheNearest) {
  params.min_view_share = 0.3;
  const NearestKeyframe nearest =
      find_nearest_keyframe(camera, row_of_keyframes(camera), move(0.2, 0, 0), params);
  EXPECT_EQ(nearest.id, 4);
  EXPECT_EQ(nearest.flow_px, nearest.reference_flow_px);
}

// ---- the policy over frames ----

TrackResult tracked_at(const SE3& T_cam_ref) {
  TrackResult r;
  r.T_cur_ref = T_cam_ref;
  return r;
}

class KeyframeActions : public KeyframeReasons {
 protected:
  Reference reference() const {
    Reference r;
    r.cloud = grid_cloud(camera);
    r.T_keyframe_world[0] = SE3();
    return r;
  }
  KeyframePolicy policy{camera, params};
};

TEST_F(KeyframeActions, AnActionHasAReason) {
  EXPECT_EQ(policy.decide(tracked_at(SE3()), reference(), false).action, KeyframeDecision::Action::kNone);
  EXPECT_FALSE(policy.follows_keyframe());
  const KeyframeDecision made = policy.decide(tracked_at(move(0, 0, -1.2)), reference(), false);
  EXPECT_EQ(made.action, KeyframeDecision::Action::kMake);
  EXPECT_EQ(made.reason, KeyframeReason::kParallax);
  EXPECT_TRUE(policy.follows_keyframe());
}

TEST_F(KeyframeActions, WaitsForMappingAndCounts) {
  for (int i = 1; i <= 3; ++i) {
    EXPECT_EQ(policy.decide(tracked_at(move(0, 0, -1.2)), reference(), true).action,
              KeyframeDecision::Action::kPostpone);
    EXPECT_EQ(policy.postponed(), i);
    EXPECT_FALSE(policy.follows_keyframe()) << "none was made";
  }
  EXPECT_EQ(policy.decide(tracked_at(SE3()), reference(), true).action, KeyframeDecision::Action::kNone);
  EXPECT_EQ(policy.postponed(), 0);
}

TEST_F(KeyframeActions, ReturnsToAnOlderKeyframe) {
  params.min_view_share = 0.3;
  KeyframePolicy by_share(camera, params);
  Reference row = row_of_keyframes(camera);
  const KeyframeDecision d = by_share.decide(tracked_at(move(2, 0, 0)), row, false);
  EXPECT_EQ(d.action, KeyframeDecision::Action::kReturn);
  EXPECT_EQ(d.reason, KeyframeReason::kReturn);
  EXPECT_EQ(d.return_to, 2);
  params.return_to_keyframes = false;
  KeyframePolicy never(camera, params);
  EXPECT_NE(never.decide(tracked_at(move(2, 0, 0)), row, false).action, KeyframeDecision::Action::kReturn);
}

}  // namespace
}  // namespace edgevo
