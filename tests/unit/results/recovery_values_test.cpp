// SPDX-License-Identifier: BSD-3-Clause
// What comes back of each kind of event that the recovery log holds.
#include "recovery_values.h"

#include <gmock/gmock.h>

#include "edgevo/core/depth_source.h"
#include "edgevo/core/random.h"
#include "recovery_logs.h"

namespace edgevo {
namespace {

const SE3 kPose(Eigen::Quaterniond(0.9, 0.1, -0.2, 0.3), {1.0 / 3, 2, -3});

TEST_F(RecoveryLogs, RestoresTheHeader) {
  write_frames(0);
  const RecoveryLogReader reader(folder_.string());
  const RecoveryHeader& back = reader.header();
  EXPECT_EQ(back.info.command_line, header().info.command_line);
  EXPECT_EQ(back.info.notes, header().info.notes);
  EXPECT_EQ(back.info.camera.pinhole().fx, made_.camera.pinhole().fx);
  EXPECT_EQ(back.info.camera.distortion().k1, made_.camera.distortion().k1);
  EXPECT_EQ(back.scale, "odometry");
  ASSERT_EQ(back.tracks.at(VehicleSensor::kGps).positions.size(), 2u);
  EXPECT_EQ(back.tracks.at(VehicleSensor::kGps).positions[1].position, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(back.T_vehicle_cam->translation().z(), 1.5);
}

TEST_F(RecoveryLogs, RestoresTheBeginningOfASegment) {
  const auto back =
      there_and_back(SegmentPlaced{3, {1.0 / 3, kPose}, SegmentPlaced::Method::kDepthRatio, 0.25});
  EXPECT_EQ(back.segment, 3);
  EXPECT_EQ(back.T_world_map.scale, 1.0 / 3);
  expect_same(back.T_world_map.rigid, kPose);
  EXPECT_EQ(back.method, SegmentPlaced::Method::kDepthRatio);
  EXPECT_EQ(back.scale_sigma, 0.25);
}

TEST_F(RecoveryLogs, RestoresAKeyframe) {
  const auto added = there_and_back(KeyframeAdded{7, 21, 2});
  EXPECT_EQ(added.id, 7);
  EXPECT_EQ(added.frame_index, 21);
  EXPECT_EQ(added.segment, 2);
  KeyframeMarginalised event{7, std::make_shared<const KeyframeRecord>(made_.run.keyframes[3]), {}};
  event.neighbours = {{8, kPose, Matrix6d::Constant(0.1)}, {9, SE3(), Matrix6d::Zero()}};
  const auto back = there_and_back(event);
  EXPECT_EQ(back.id, 7);
  ASSERT_EQ(back.neighbours.size(), 2u);
  EXPECT_EQ(back.neighbours[0].id, 8);
  expect_same(back.neighbours[0].T_leaving_neighbour, kPose);
  EXPECT_EQ(back.neighbours[0].covariance, Matrix6d::Constant(0.1));
  const KeyframeRecord &a = *back.keyframe, &b = *event.keyframe;
  EXPECT_EQ(a.frame_index, b.frame_index);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.segment, b.segment);
  expect_same(a.T_world_cam, b.T_world_cam);
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(a.points[9].px, b.points[9].px);
  EXPECT_EQ(a.points[9].normal, b.points[9].normal);
  EXPECT_EQ(a.points[9].idepth, b.points[9].idepth);
  EXPECT_EQ(a.points[9].idepth_sigma, b.points[9].idepth_sigma);
  EXPECT_EQ(a.points[9].observations, b.points[9].observations);
  EXPECT_EQ(a.points[9].gray, b.points[9].gray);
}

TEST_F(RecoveryLogs, RestoresAMoveOfTheMap) {
  MapMoved event{MoveReason::kCamera, 1, kPose, {}, LensChange{{0.01, 0}, {0.02, 0.03}}, BaPrior()};
  KeyframeMove move{4, kPose.inverse(), 1.1, {{{1.5, 2.5}, 0.7}}, {}};
  move.motion.velocity.setConstant(0.25);
  move.motion.turning.setConstant(-3);
  move.motion.idepth.setConstant(0.5);
  event.keyframes = {move, {6, SE3(), 0.9, {}, {}}};
  const auto back = there_and_back(event);
  EXPECT_EQ(back.reason, MoveReason::kCamera);
  EXPECT_EQ(back.segment, 1);
  expect_same(back.T_newest_map, kPose);
  EXPECT_EQ(back.lens->before, event.lens->before);
  EXPECT_EQ(back.lens->now, event.lens->now);
  EXPECT_FALSE(back.prior) << "only the window needs it";
  ASSERT_EQ(back.keyframes.size(), 2u);
  EXPECT_EQ(back.keyframes[0].id, 4);
  expect_same(back.keyframes[0].T_cam_newest, move.T_cam_newest);
  EXPECT_EQ(back.keyframes[0].scale_ratio, 1.1);
  ASSERT_EQ(back.keyframes[0].points.size(), 1u);
  EXPECT_EQ(back.keyframes[0].points[0].px, Eigen::Vector2d(1.5, 2.5));
  EXPECT_EQ(back.keyframes[0].points[0].idepth, 0.7);
  EXPECT_EQ(back.keyframes[0].motion.velocity, move.motion.velocity);
  EXPECT_EQ(back.keyframes[0].motion.turning, move.motion.turning);
  EXPECT_EQ(back.keyframes[0].motion.idepth, move.motion.idepth);
  EXPECT_TRUE(back.keyframes[1].points.empty());
  EXPECT_FALSE(there_and_back(MapMoved()).lens);
}

TEST_F(RecoveryLogs, RestoresLinesCameraAndTimes) {
  EdgeLine line;
  line.vertices = {{{1, 2}, 0.5f, 0.1f, 3, 4}, {{5, 6}, 0.7f, 0.2f, 7, 8}};
  line.keyframes = 9, line.views = 5, line.source = DepthSource::kPlane;
  line.is_outline = true;
  const auto lines = there_and_back(LinesFinished{5, {line, EdgeLine()}});
  EXPECT_EQ(lines.keyframe_id, 5);
  ASSERT_EQ(lines.lines.size(), 2u);
  EXPECT_EQ(lines.lines[0].vertices.at(1).px, Eigen::Vector2f(5, 6));
  EXPECT_EQ(lines.lines[0].vertices.at(1).idepth_sigma, 0.2f);
  EXPECT_EQ(lines.lines[0].vertices.at(1).gray_bright, 8);
  EXPECT_EQ(lines.lines[0].keyframes, 9);
  EXPECT_EQ(lines.lines[0].views, 5);
  EXPECT_EQ(lines.lines[0].source, DepthSource::kPlane);
  EXPECT_TRUE(lines.lines[0].is_outline);
  EXPECT_FALSE(lines.lines[0].is_straight);
  CameraPosterior camera;
  camera.applied = {0.01, 0.1, 0.2};
  camera.readout_given_s = 0.09;
  camera.is_sought = {true, false, false, true};
  camera.corners = {0.2, 0.05, 4, 3};
  camera.given.set(CameraNumber::kK1, 0.02, 0.003), camera.given.keyframes = 44;
  camera.whole.set(CameraNumber::kK2, -0.02, 0.05), camera.whole.keyframes = 7;
  const auto estimated = there_and_back(CameraEstimated{camera}).camera;
  EXPECT_EQ(estimated.applied, camera.applied);
  EXPECT_EQ(estimated.readout_given_s, 0.09);
  EXPECT_EQ(estimated.is_sought, camera.is_sought);
  EXPECT_EQ(estimated.given.covariance, camera.given.covariance);
  EXPECT_EQ(estimated.given.keyframes, 44);
  EXPECT_EQ(estimated.whole.mean, camera.whole.mean);
  EXPECT_EQ(estimated.whole.keyframes, 7);
  EXPECT_EQ(estimated.corners.focal, 0.2);
  EXPECT_EQ(estimated.corners.windows, 4);
  EXPECT_EQ(estimated.corners.windows_weighed, 3);
  const auto mapped = there_and_back(
      FrameMapped{12, {{"ba", 1.25}, {"depth_filter", 0.5}}, AdjustmentEvidence{0.9, 1.5, 800, 300, 90}});
  EXPECT_EQ(mapped.frame_index, 12);
  EXPECT_EQ(mapped.times, (StageTimes{{"ba", 1.25}, {"depth_filter", 0.5}}));
  EXPECT_EQ(mapped.adjustment->moved, 0.9);
  EXPECT_EQ(mapped.adjustment->cost_per_match, 1.5);
  EXPECT_EQ(mapped.adjustment->matches_in_newest, 90);
}

TEST_F(RecoveryLogs, RestoresAFrameAndItsAnchor) {
  FrameAnchored event{made_.run.frames[30], FrameAnchor{90, kPose, kPose.inverse(), 2}};
  event.frame.latency_ms = 12.5;
  event.frame.reasons = {{ReasonKind::kInlierShare, 0.3, 0.4}, {ReasonKind::kTurn}};
  event.frame.note = to_string(event.frame.reasons);
  const auto back = there_and_back(event);
  EXPECT_TRUE(are_alike(back.frame.reasons, event.frame.reasons));
  EXPECT_EQ(frames_csv_row(back.frame, {}), frames_csv_row(event.frame, {}));
  EXPECT_EQ(back.frame.latency_ms, 12.5);
  EXPECT_EQ(back.frame.covariance, event.frame.covariance);
  expect_same(*back.frame.T_world_cam_live, *event.frame.T_world_cam_live);
  EXPECT_EQ(back.anchor->keyframe_id, 90);
  expect_same(back.anchor->T_cam_ref, kPose);
  expect_same(back.anchor->T_cam_map, kPose.inverse());
  EXPECT_EQ(back.anchor->moves, 2);
}

TEST_F(RecoveryLogs, RestoresAFrameWithoutAPose) {
  const auto lost = there_and_back(FrameAnchored{made_.run.frames[22], std::nullopt});
  EXPECT_FALSE(lost.anchor);
  EXPECT_FALSE(lost.frame.latency_ms);
  EXPECT_FALSE(lost.frame.T_world_cam_live);
}

}  // namespace
}  // namespace edgevo
