// SPDX-License-Identifier: BSD-3-Clause
// The recovery log is read back completely up to where the file ends.
#include "edgevo/results/recovery_log.h"

#include <gmock/gmock.h>

#include "edgevo/core/output_file.h"
#include "edgevo/core/random.h"
#include "edgevo/map/run_builder.h"
#include "growing_file.h"
#include "recovered_run.h"
#include "recovery_values.h"
#include "support/made_events.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::FrameEvents;
using test::MadeEvents;
using ::testing::HasSubstr;

constexpr size_t kBeforeMove = MadeEvents::kMovedAfter, kAfterMove = kBeforeMove + 1;

class RecoveryLogs : public WrittenRun {
 protected:
  RecoveryLogs() { fs::create_directories(folder_); }

  RecoveryHeader header() const {
    RecoveryHeader h;
    h.info.command_line = {"edgevo", "run", "a \"quoted\" folder"};
    h.info.source_kind = "synthetic";
    h.info.camera = made_.camera;
    h.info.notes = {{"seed", "3"}};
    h.scale = "odometry";
    h.track.positions = {{Timestamp{5}, {1, 2, 3}}, {Timestamp{7}, {4, 5, 6}}};
    h.T_vehicle_cam = SE3(Eigen::Quaterniond::Identity(), {0, 0, 1.5});
    return h;
  }
  // Writes the events of the first frames as a run does.
  void write_frames(size_t frames) const {
    RecoveryLog log(folder_.string(), header());
    for (size_t i = 0; i < frames; ++i) log.add(events_.frames()[i]);
  }
  size_t all_frames() const { return events_.frames().size(); }
  std::string bytes() const { return content(folder_ / kRecoveryLog); }
  void put(const std::string& bytes) const { write_file((folder_ / kRecoveryLog).string(), bytes); }
  std::vector<MapEvent> read() const {
    RecoveryLogReader reader(folder_.string());
    std::vector<MapEvent> events;
    while (auto event = reader.next()) events.push_back(std::move(*event));
    return events;
  }
  edgevo::Run recovered() const { return test::run_from(made_.run.pinhole, read()); }
  // The run that the events of the first frames make without a detour over the disk.
  edgevo::Run direct(size_t frames) const {
    std::vector<MapEvent> events;
    for (size_t i = 0; i < frames; ++i)
      for (const auto& event : events_.frames()[i]) events.push_back(*event);
    return test::run_from(made_.run.pinhole, events);
  }
  // What comes back of one event.
  template <class Event>
  Event there_and_back(Event event) const {
    FrameEvents events;
    test::append(std::move(event), &events);
    RecoveryLog(folder_.string(), header()).add(events);
    return std::get<Event>(read().at(0));
  }

  const MadeEvents events_{made_};
};

void expect_same(const SE3& a, const SE3& b) {
  EXPECT_EQ(a.translation(), b.translation());
  EXPECT_EQ(a.rotation().coeffs(), b.rotation().coeffs());
}

// ---- each kind of event ----

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
  ASSERT_EQ(back.track.positions.size(), 2u);
  EXPECT_EQ(back.track.positions[1].position, Eigen::Vector3d(4, 5, 6));
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
  EXPECT_EQ(back.keyframes[0].motion.idepth, move.motion.idepth);
  EXPECT_TRUE(back.keyframes[1].points.empty());
  EXPECT_FALSE(there_and_back(MapMoved()).lens);
}

TEST_F(RecoveryLogs, RestoresLinesCameraAndTimes) {
  EdgeLine line;
  line.vertices = {{{1, 2}, 0.5f, 0.1f, 3, 4}, {{5, 6}, 0.7f, 0.2f, 7, 8}};
  line.keyframes = 9;
  line.is_outline = true;
  const auto lines = there_and_back(LinesFinished{5, {line, EdgeLine()}});
  EXPECT_EQ(lines.keyframe_id, 5);
  ASSERT_EQ(lines.lines.size(), 2u);
  EXPECT_EQ(lines.lines[0].vertices.at(1).px, Eigen::Vector2f(5, 6));
  EXPECT_EQ(lines.lines[0].vertices.at(1).idepth_sigma, 0.2f);
  EXPECT_EQ(lines.lines[0].vertices.at(1).gray_bright, 8);
  EXPECT_EQ(lines.lines[0].keyframes, 9);
  EXPECT_TRUE(lines.lines[0].is_outline);
  EXPECT_FALSE(lines.lines[0].is_straight);
  CameraRefinement camera;
  camera.state = CameraRefinement::State::kApplied;
  camera.correction = {0.01, 0.1, 0.2};
  camera.focal_length = {CameraRefinement::State::kApplied, 0.2, 0.05, 4, 3};
  camera.estimate = 0.02, camera.sigma = 0.003, camera.keyframes = 44;
  camera.shutter = {CameraRefinement::State::kTooEarly, 0.2, 0.3, 5};
  camera.lens = {0.01, -0.02, 0.03, 0.04, 0.05, 0.06, 7};
  const auto estimated = there_and_back(CameraEstimated{camera}).camera;
  EXPECT_EQ(estimated.state, CameraRefinement::State::kApplied);
  EXPECT_EQ(estimated.correction, camera.correction);
  EXPECT_EQ(estimated.sigma, 0.003);
  EXPECT_EQ(estimated.keyframes, 44);
  EXPECT_EQ(estimated.shutter.estimate, 0.2);
  EXPECT_EQ(estimated.shutter.keyframes, 5);
  EXPECT_EQ(estimated.focal_length.estimate, 0.2);
  EXPECT_EQ(estimated.focal_length.windows, 4);
  EXPECT_EQ(estimated.focal_length.windows_rejected, 3);
  EXPECT_EQ(estimated.lens.k2, -0.02);
  EXPECT_EQ(estimated.lens.focal, 0.03);
  EXPECT_EQ(estimated.lens.focal_sigma, 0.06);
  EXPECT_EQ(estimated.lens.keyframes, 7);
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
  EXPECT_EQ(to_string(back.frame.reasons), event.frame.note);
  EXPECT_EQ(frames_csv_row(back.frame, {}), frames_csv_row(event.frame, {}));
  EXPECT_EQ(back.frame.latency_ms, 12.5);
  EXPECT_EQ(back.frame.covariance, event.frame.covariance);
  expect_same(*back.frame.T_world_cam_live, *event.frame.T_world_cam_live);
  EXPECT_EQ(back.anchor->keyframe_id, 90);
  expect_same(back.anchor->T_cam_ref, kPose);
  expect_same(back.anchor->T_cam_map, kPose.inverse());
  EXPECT_EQ(back.anchor->moves, 2);
  const auto lost = there_and_back(FrameAnchored{made_.run.frames[22], std::nullopt});
  EXPECT_FALSE(lost.anchor);
  EXPECT_FALSE(lost.frame.latency_ms);
  EXPECT_FALSE(lost.frame.T_world_cam_live);
}

// ---- whole runs ----

TEST_F(RecoveryLogs, GivesTheRunThatItsEventsMake) {
  for (const size_t frames :
       {size_t(3), size_t(5), size_t(18), size_t(22), kBeforeMove, kAfterMove, all_frames()}) {
    write_frames(frames);
    EXPECT_EQ(recovered().frames.size(), frames);
    test::expect_same_run(recovered(), direct(frames));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
}

TEST_F(RecoveryLogs, HoldsPosesFoundLaterByABootstrap) {
  write_frames(MadeEvents::kFirstPose);
  EXPECT_FALSE(recovered().frames[2].T_world_cam_live);
  write_frames(MadeEvents::kFirstPose + 1);
  EXPECT_TRUE(recovered().frames[2].T_world_cam_live);
  EXPECT_EQ(recovered().frames.size(), size_t(MadeEvents::kFirstPose + 1));
}

TEST_F(RecoveryLogs, FollowsAPastThatMovesWithoutTheCamera) {
  const auto length = [](const edgevo::Run& run) {  // from keyframe to keyframe, behind the window
    return (run.keyframes[8].T_world_cam.translation() - run.keyframes[7].T_world_cam.translation()).norm();
  };
  write_frames(kBeforeMove);
  const edgevo::Run before = recovered();
  write_frames(kAfterMove);
  const edgevo::Run after = recovered();
  EXPECT_NEAR(length(after), MadeEvents::kGrowth * length(before), 1e-9);
  EXPECT_NEAR(double(after.keyframes[8].points[0].idepth),
              double(before.keyframes[8].points[0].idepth) / MadeEvents::kGrowth, 1e-6);
  EXPECT_NEAR(after.keyframes[0].points[0].idepth, before.keyframes[0].points[0].idepth, 1e-9)
      << "other segment";
  expect_same(*after.frames[41].T_world_cam_live, *before.frames[41].T_world_cam_live);
}

TEST_F(RecoveryLogs, AKillRightAfterAMoveCostsTheWindow) {
  write_frames(kBeforeMove);
  const std::string window = content(folder_ / kRunWindow);
  const size_t keyframes = recovered().keyframes.size();
  write_frames(kAfterMove);
  write_file((folder_ / kRunWindow).string(), window);
  const edgevo::Run back = recovered();
  EXPECT_EQ(back.keyframes.size() + MadeEvents::kWindow, keyframes + 1) << "one more was marginalised";
  const FrameRecord& newest = back.frames.back();
  ASSERT_TRUE(newest.T_world_cam) << "it has its live pose";
  EXPECT_EQ(newest.reference_keyframe, -1);
}

TEST_F(RecoveryLogs, AWindowFromBeforeAKeyframeWasMarginalisedDuplicatesNone) {
  write_frames(13);  // with keyframe 12
  const std::string window = content(folder_ / kRunWindow);
  write_frames(16);  // with keyframe 15
  const size_t keyframes = recovered().keyframes.size();
  write_file((folder_ / kRunWindow).string(), window);
  EXPECT_EQ(recovered().keyframes.size(), keyframes - 1) << "the newest";
}

TEST_F(RecoveryLogs, AWindowOfAClosedMapAddsNothing) {
  write_frames(20);
  const std::string window = content(folder_ / kRunWindow);
  const size_t keyframes = recovered().keyframes.size();
  write_frames(21);  // lost: the map is closed
  EXPECT_EQ(recovered().keyframes.size(), keyframes);
  write_file((folder_ / kRunWindow).string(), window);
  EXPECT_EQ(recovered().keyframes.size(), keyframes);
}

TEST_F(RecoveryLogs, TheWindowOfAnotherRunIsGone) {
  write_frames(20);
  ASSERT_TRUE(fs::exists(folder_ / kRunWindow));
  const RecoveryLog next(folder_.string(), header());
  EXPECT_FALSE(fs::exists(folder_ / kRunWindow));
}

TEST_F(RecoveryLogs, AnIncompleteWindowCostsTheWindowOnly) {
  write_frames(19);
  const std::string whole = content(folder_ / kRunWindow);
  const size_t keyframes = recovered().keyframes.size();
  for (size_t length = 0; length < whole.size(); length += whole.size() / 40) {
    write_file((folder_ / kRunWindow).string(), whole.substr(0, length));
    EXPECT_EQ(recovered().keyframes.size(), keyframes - MadeEvents::kWindow) << length;
  }
}

// ---- damage ----

// The contents of the events, with their kinds.
std::vector<std::string> contents(const std::vector<MapEvent>& events) {
  std::vector<std::string> all;
  for (const MapEvent& event : events) all.push_back(char(kind_of(event)) + bytes_of(event));
  return all;
}

class SmallRecoveryLogs : public RecoveryLogs {
 protected:
  SmallRecoveryLogs() {
    RecoveryLog log(folder_.string(), header());
    for (const FrameEvents& events : small_.frames()) log.add(events);
    fs::remove(folder_ / kRunWindow);
  }
  const MadeEvents small_{test::synthetic_run(45, 4)};
};

TEST_F(SmallRecoveryLogs, ATruncatedLogIsReadUpToItsEnd) {
  const std::string all = bytes();
  const std::vector<std::string> written = contents(read());
  size_t before = 0;
  for (size_t length = 600; length < all.size(); length += 17) {
    put(all.substr(0, length));
    const std::vector<MapEvent> events = read();
    const std::vector<std::string> back = contents(events);
    ASSERT_GE(back.size(), before) << length;
    ASSERT_LE(back.size(), written.size());
    ASSERT_TRUE(std::equal(back.begin(), back.end(), written.begin())) << length;
    if (back.size() != before) test::run_from(made_.run.pinhole, events);
    before = back.size();
  }
  EXPECT_GE(before, written.size() - 1);
}

TEST_F(SmallRecoveryLogs, DamageEndsItAndIsNeverReadAsAnEvent) {
  const std::string all = bytes();
  const std::vector<std::string> written = contents(read());
  Random random(5);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = all;
    damaged[size_t(random.below(int(all.size())))] ^= char(1 << random.below(8));
    put(damaged);
    try {
      const std::vector<std::string> back = contents(read());
      ASSERT_LT(back.size(), written.size());
      ASSERT_TRUE(std::equal(back.begin(), back.end(), written.begin()));
    } catch (const InputError&) {
      ++refused;  // damaged header
    }
  }
  EXPECT_LT(refused, 30);
}

TEST_F(RecoveryLogs, OtherFilesAreRefused) {
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("holds no interrupted run"));
  put("a letter");
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("is incomplete or no recovery log"));
  for (const char* other : {"edgevo run journal 1\n", "edgevo recovery log 2\n"}) {
    put(other + std::string(100, 'x'));
    EXPECT_THAT(
        message_of([&] { read(); }),
        HasSubstr("was written by another version of edgevo; finish the run with that version, or run the "
                  "sequence again with --force"));
  }
  RecoveryLog log(folder_.string(), header());
  EXPECT_THAT(message_of([&] { read(); }), HasSubstr("its run is still in progress"));
  EXPECT_THAT(message_of([&] { RecoveryLog(folder_.string(), header()); }), HasSubstr("cannot be written"));
}

TEST_F(RecoveryLogs, AFullDiskEndsTheLogButNotTheRun) {
  fs::create_symlink("/dev/full", folder_ / kRecoveryLog);
  RecoveryLog log(folder_.string(), header());
  for (const FrameEvents& events : events_.frames()) log.add(events);
  EXPECT_TRUE(log.is_broken());
  EXPECT_TRUE(fs::is_empty(folder_)) << "its space is for the results";
}

TEST_F(RecoveryLogs, RemovesItsFiles) {
  RecoveryLog log(folder_.string(), header());
  for (size_t i = 0; i < kBeforeMove; ++i) log.add(events_.frames()[i]);
  EXPECT_FALSE(fs::is_empty(folder_));
  log.remove();
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace edgevo
