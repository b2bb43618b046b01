// SPDX-License-Identifier: BSD-3-Clause
// The result of a run from hand-made events.
#include "edgevo/map/run_builder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/point_filter.h"
#include "edgevo/map/corrected_pixel.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo {
namespace {

const SE3 kOneAhead(Eigen::Quaterniond::Identity(), {0, 0, -1});  // T_cam_ref of a camera 1 ahead
const SE3 kTurned(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), {0.5, -0.2, 3});

SegmentPlaced at_origin(int segment = 0) {
  SegmentPlaced placed;
  placed.segment = segment;
  return placed;
}

FrameAnchored frame(int index, std::optional<FrameAnchor> anchor = std::nullopt, int segment = 0) {
  FrameAnchored e;
  e.frame.index = index;
  e.frame.time = Timestamp::from_seconds(0.1 * index);
  e.frame.covariance = Matrix6d::Ones();
  e.frame.evidence.median_depth = 1;
  e.anchor = anchor;
  if (!anchor) return e;
  e.frame.segment = segment;
  e.frame.T_world_cam_live = anchor->T_cam_map.inverse();
  return e;
}

KeyframeMarginalised keyframe(int id, int frame_index, const SE3& T_map_cam = {}, int segment = 0) {
  KeyframeRecord record;
  record.frame_index = frame_index;
  record.segment = segment;
  record.T_world_cam = T_map_cam;
  record.points.push_back({{100, 100}, {1, 0}, 1e-3f, 1e-4f, 3, 0});
  return {id, std::make_shared<const KeyframeRecord>(record), {}};
}

MapMoved move_of(int id, const SE3& T_cam_newest, double scale_ratio) {
  MapMoved moved;
  moved.keyframes.resize(1);
  moved.keyframes[0].id = id;
  moved.keyframes[0].T_cam_newest = T_cam_newest;
  moved.keyframes[0].scale_ratio = scale_ratio;
  return moved;
}

edgevo::Run build(const std::vector<MapEvent>& events) {
  RunBuilder builder(test::pinhole());
  for (const MapEvent& e : events) builder.apply(e);
  return builder.finish();
}

// A point that a move takes to infinity does not become more certain: its standard deviation follows the unit
// of length, not its own inverse depth.
TEST(RunBuilder, AMoveScalesTheSigmaOfAFarPointByTheUnit) {
  MapMoved moved = move_of(1, {}, 2);
  moved.keyframes[0].points = {{{100, 100}, 1e-6}};
  const edgevo::Run run = build({at_origin(), keyframe(1, 0), moved});
  ASSERT_EQ(run.keyframes.size(), 1u);
  const EdgePoint& point = run.keyframes[0].points.at(0);
  EXPECT_FLOAT_EQ(point.idepth, 1e-6f);
  EXPECT_FLOAT_EQ(point.idepth_sigma, 0.5e-4f);
  EXPECT_FALSE(PointFilter().keeps(point));
}

TEST(RunBuilder, AMoveWithoutALensScalesPointsAndLines) {
  EdgeLine line;
  line.vertices = {{{10, 20}, 0.5f, 0.01f, 1, 2}, {{11, 20}, 0.25f, 0.02f, 1, 2}};
  const edgevo::Run run =
      build({at_origin(), keyframe(1, 0), LinesFinished{1, {line}}, move_of(1, kTurned, 4)});
  const KeyframeRecord& k = run.keyframes.at(0);
  EXPECT_LT((k.T_world_cam * kTurned).log().norm(), 1e-12);
  EXPECT_FLOAT_EQ(k.points.at(0).idepth, 0.25e-3f);
  EXPECT_EQ(k.points.at(0).px, Eigen::Vector2f(100, 100));
  EXPECT_FLOAT_EQ(k.lines.at(0).vertices.at(1).idepth, 0.0625f);
  EXPECT_FLOAT_EQ(k.lines.at(0).vertices.at(1).idepth_sigma, 0.005f);
  EXPECT_EQ(k.lines.at(0).vertices.at(1).px, Eigen::Vector2f(11, 20));
}

// A frame that was tracked before a move changed the unit of length at its keyframe is converted to the new
// unit, together with its covariance; one that was tracked against the map after it is in that unit already.
TEST(RunBuilder, AMoveChangesTheUnitOfEarlierFramesOnly) {
  constexpr int kKeyframe = 7;
  const edgevo::Run run = build(
      {at_origin(), frame(0, FrameAnchor{kKeyframe, kOneAhead, kOneAhead, 0}), move_of(kKeyframe, {}, 2),
       // Tracked while the map moved: against what was published before.
       frame(1, FrameAnchor{kKeyframe, kOneAhead, kOneAhead, 0}),
       frame(2, FrameAnchor{kKeyframe, kOneAhead, kOneAhead, 1}), keyframe(kKeyframe, 100)});
  ASSERT_EQ(run.frames.size(), 3u);
  for (const int i : {0, 1, 2}) {
    const double unit = i < 2 ? 2 : 1;
    const SE3 T_ref_cam = run.keyframes.at(0).T_world_cam.inverse() * *run.frames[size_t(i)].T_world_cam;
    EXPECT_NEAR(T_ref_cam.translation().z(), unit, 1e-12) << i;
    const Matrix6d& covariance = run.frames[size_t(i)].covariance;
    EXPECT_NEAR(covariance(2, 2), unit * unit, 1e-12) << i;
    EXPECT_NEAR(covariance(2, 5), unit, 1e-12) << i;
    EXPECT_NEAR(run.frames[size_t(i)].evidence.median_depth, unit, 1e-12) << i;
    EXPECT_NEAR(covariance(5, 5), 1, 1e-12) << "angles have no unit of length, " << i;
    EXPECT_EQ(run.frames[size_t(i)].T_world_cam_live->translation().z(), 1) << "live poses never change";
  }
}

// A frame between keyframes was tracked with the focal length of before.
TEST(RunBuilder, AMoveByTheFocalLengthCorrectsEarlierFrames) {
  constexpr int kKeyframe = 7;
  const SE3 turn = SE3::exp((Vector6d() << 0.1, 0, 0.5, 0, 0.05, 0).finished());
  MapMoved moved = move_of(kKeyframe, {}, 2);
  moved.keyframes[0].points = {{{100, 100}, 1e-3}};
  moved.lens = LensChange{{}, {0, 0, 0.25}};
  const edgevo::Run run = build({at_origin(), frame(0, FrameAnchor{kKeyframe, turn, turn, 0}), moved,
                                 frame(1, FrameAnchor{kKeyframe, turn, turn, 1}), keyframe(kKeyframe, 100)});
  const auto T_cam_ref = [&](size_t i) {
    return run.frames.at(i).T_world_cam->inverse() * run.keyframes.at(0).T_world_cam;
  };
  EXPECT_NEAR(T_cam_ref(0).angle(), 0.05 / 1.25, 1e-9);
  const SE3 expected = correct_motion(turn, 1 / 1.25);
  EXPECT_LT((T_cam_ref(0).translation() - 2 * expected.translation()).norm(), 1e-9);
  EXPECT_LT((T_cam_ref(1) * turn.inverse()).log().norm(), 1e-9) << "tracked after it";
}

TEST(RunBuilder, TheWorldBeginsAtTheFirstPoseOnceTheMapHasMoved) {
  const std::vector<MapEvent> events{at_origin(), frame(0, FrameAnchor{1, {}, {}, 0}),
                                     frame(1, FrameAnchor{1, kOneAhead, kOneAhead, 0}), keyframe(1, 0)};
  EXPECT_LT(build(events).frames[0].T_world_cam->log().norm(), 1e-12);
  std::vector<MapEvent> moved = events;
  moved.push_back(move_of(1, kTurned, 1));
  const edgevo::Run run = build(moved);
  EXPECT_LT(run.frames[0].T_world_cam->log().norm(), 1e-12);
  EXPECT_LT((*run.frames[1].T_world_cam * kOneAhead).log().norm(), 1e-12);
}

TEST(RunBuilder, AKeyframesOwnFrameTakesItsPose) {
  const edgevo::Run run = build({at_origin(), frame(0, FrameAnchor{0, kOneAhead, kOneAhead, 0}),
                                 keyframe(0, 5), keyframe(1, 0, kTurned)});
  EXPECT_TRUE(run.frames[0].is_keyframe);
  EXPECT_EQ(run.frames[0].keyframe_reason, KeyframeReason::kBootstrap);
  EXPECT_EQ(run.frames[0].reference_keyframe, 1);
  EXPECT_LT((run.frames[0].T_world_cam->inverse() * kTurned).log().norm(), 1e-12);
}

// A bootstrap finds the poses of frames that had none; the order of the frames is that of their arrival.
TEST(RunBuilder, ASecondEventOfAFrameReplacesTheFirst) {
  RunBuilder builder(test::pinhole());
  FrameAnchored waiting = frame(0);
  waiting.frame.note = "too little parallax";
  for (const MapEvent& e :
       std::vector<MapEvent>{waiting, FrameMapped{0, {{"window", 2}}}, frame(1), at_origin(),
                             frame(0, FrameAnchor{3, {}, kTurned, 0}),
                             frame(1, FrameAnchor{3, kOneAhead, kOneAhead, 0}), keyframe(3, 9)})
    builder.apply(e);
  EXPECT_EQ(builder.frames(), 2u);
  EXPECT_EQ(builder.find(2), nullptr);
  EXPECT_EQ(builder.find(0)->note, "");
  EXPECT_FALSE(builder.pose_before(0, 0));
  EXPECT_FALSE(builder.pose_before(1, 1)) << "of another segment";
  EXPECT_LT((builder.pose_before(1, 0)->inverse() * kTurned).log().norm(), 1e-12);
  const std::vector<TimedPose> last = builder.last_poses(0, 1, 5);
  ASSERT_EQ(last.size(), 2u);
  EXPECT_LT(last[0].time, last[1].time);
  EXPECT_EQ(builder.last_poses(0, 0, 5).size(), 1u);
  EXPECT_EQ(builder.last_poses(0, 1, 1).size(), 1u);
  EXPECT_EQ(builder.last_trusted_poses(0, 1, 2).size(), 2u);
  EXPECT_TRUE(builder.last_trusted_poses(0, 1, 3).empty());
  const edgevo::Run run = builder.finish();
  EXPECT_EQ(run.frames[0].index, 0);
  EXPECT_TRUE(run.frames[0].T_world_cam);
  ASSERT_EQ(run.frames[0].stage_ms.size(), 1u);
  EXPECT_EQ(run.frames[0].stage_ms[0].first, "window");
}

TEST(RunBuilder, SegmentsHaveAUnitOfTheirOwn) {
  SegmentPlaced second = at_origin(1);
  second.T_world_map = {3, kTurned};
  const edgevo::Run run = build({at_origin(), second, keyframe(4, 2, kOneAhead.inverse(), 1),
                                 frame(3, FrameAnchor{4, kOneAhead, kOneAhead * kOneAhead, 0}, 1)});
  EXPECT_LT((run.keyframes[0].T_world_cam.translation() - kTurned * Eigen::Vector3d(0, 0, 3)).norm(), 1e-12);
  EXPECT_FLOAT_EQ(run.keyframes[0].points[0].idepth, 1e-3f / 3);
  EXPECT_LT((run.frames[0].T_world_cam->translation() - kTurned * Eigen::Vector3d(0, 0, 6)).norm(), 1e-12);
  EXPECT_NEAR(run.frames[0].covariance(0, 0), 9, 1e-12);
}

// ---- a log that was cut off ----

WindowAdjusted window_of(const std::vector<int>& ids, int moves) {
  auto active = std::make_shared<std::vector<WindowAdjusted::Active>>();
  for (const int id : ids) active->push_back({id, *keyframe(id, 10 + id).keyframe});
  return {moves, active};
}

TEST(RunBuilder, AnInterruptedRunKeepsTheKeyframesOfItsWindow) {
  RunBuilder builder(test::pinhole());
  EXPECT_EQ(builder.adopt_window(), 0u);
  for (const MapEvent& e : std::vector<MapEvent>{at_origin(), frame(11), frame(12), frame(13),
                                                 window_of({1, 2, 3}, 0), keyframe(1, 11)})
    builder.apply(e);
  EXPECT_EQ(builder.adopt_window(), 2u);
  EXPECT_EQ(builder.finish().keyframes.size(), 3u);
}

TEST(RunBuilder, AWindowFromAfterTheLogWasCutOffIsNotAdopted) {
  RunBuilder builder(test::pinhole());
  for (const MapEvent& e : std::vector<MapEvent>{at_origin(), frame(11), window_of({1, 2, 3}, 0)})
    builder.apply(e);
  EXPECT_EQ(builder.adopt_window(), 1u);
}

TEST(RunBuilder, AWindowFromBeforeAMoveIsNotAdopted) {
  RunBuilder builder(test::pinhole());
  for (const MapEvent& e :
       std::vector<MapEvent>{at_origin(), frame(11), frame(12), frame(13), window_of({1, 2}, 0),
                             move_of(1, kTurned, 1), window_of({2, 3}, 0)})
    builder.apply(e);
  EXPECT_EQ(builder.adopt_window(), 0u);
  builder.apply(window_of({2, 3}, 1));
  EXPECT_EQ(builder.adopt_window(), 2u);
}

TEST(RunBuilder, EventsAboutWhatIsNotKnownAreIgnored) {
  const edgevo::Run run =
      build({keyframe(1, 0, {}, 5), LinesFinished{8, {}}, FrameMapped{3, {}}, move_of(9, {}, 2),
             frame(0, FrameAnchor{1, {}, {}, 0}, 5), at_origin(), frame(1, FrameAnchor{77, {}, {}, 0})});
  EXPECT_TRUE(run.keyframes.empty());
  ASSERT_EQ(run.frames.size(), 2u);
  EXPECT_FALSE(run.frames[0].T_world_cam);
  EXPECT_TRUE(run.frames[1].T_world_cam) << "the live pose: its keyframe is lost";
  EXPECT_EQ(run.frames[1].reference_keyframe, -1);
}

TEST(RunBuilder, ForgetsAllButTheNewestRowsAndTheKeyframes) {
  RunBuilder builder(test::pinhole());
  builder.forget_all_but(10);
  builder.apply(at_origin());
  for (int i = 0; i < 50; ++i) {
    builder.apply(frame(i, FrameAnchor{1, {}, kOneAhead, 0}));
    builder.apply(FrameMapped{i, {}});
  }
  builder.apply(keyframe(1, 3));
  builder.apply(move_of(1, kTurned, 4));
  EXPECT_EQ(builder.frames(), 50u);
  EXPECT_EQ(builder.find(39), nullptr);
  ASSERT_NE(builder.find(40), nullptr);
  EXPECT_EQ(builder.find(40)->index, 40);
  builder.apply(FrameMapped{3, {}});  // of a row that is gone
  builder.apply(frame(45, FrameAnchor{1, {}, kTurned, 0}));
  EXPECT_LT((*builder.pose_before(46, 0) * kTurned.inverse()).log().norm(), 1e-12);
  EXPECT_EQ(builder.last_poses(0, 49, 100).size(), 10u);
  const edgevo::Run run = builder.finish();
  EXPECT_TRUE(run.keyframes.empty());
  ASSERT_EQ(run.frames.size(), 10u);
  EXPECT_EQ(run.frames.front().index, 40);
  EXPECT_TRUE(run.frames.front().T_world_cam);
}

// A loss may last longer than the rows that are kept.
TEST(RunBuilder, KeepsThePlaceOfAViewThatMayBeLinkedLater) {
  RunBuilder builder(test::pinhole());
  builder.forget_all_but(10);
  builder.apply(at_origin());
  builder.apply(keyframe(1, 3));
  builder.apply(keyframe(2, 4));
  builder.keep(1);
  for (int i = 0; i < 50; ++i) builder.apply(frame(i));
  EXPECT_TRUE(builder.find_keyframe(1));
  EXPECT_FALSE(builder.find_keyframe(2));
}

}  // namespace
}  // namespace edgevo
