// SPDX-License-Identifier: BSD-3-Clause
// A program that is killed after its past has moved: the run that is recovered includes the move.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <opencv2/core/utility.hpp>

#include "edgevo/map/map.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/results/recover_run.h"
#include "edgevo/results/run_params.h"
#include "recovered_run.h"
#include "support/temp_folder.h"
#include "unit/odometry/rendered_runs.h"
#include "written_run.h"

namespace edgevo {
namespace {

constexpr int kFrames = 110;
constexpr size_t kMovedWith = 4;  // marginalised keyframes
constexpr double kGrowth = 1.2;

// Turns and enlarges the past about the newest keyframe, once, when enough of it has been marginalised.
// There is no lens in it.
class MoveOnce {
 public:
  std::optional<MapMoved> operator()(const Map& map) {
    if (has_moved_ || map.marginalised().size() < kMovedWith) return std::nullopt;
    has_moved_ = true;
    const SE3 T_newest_map = map.active().back().T_cam_world;
    const Sim3 change{kGrowth, SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY())),
                                   Eigen::Vector3d::Zero())};
    MapMoved moved;
    moved.segment = map.segment();
    for (const Keyframe& keyframe : map.marginalised()) {
      KeyframeMove move;
      move.id = keyframe.id;
      move.T_cam_newest = change.apply(T_newest_map * keyframe.T_cam_world.inverse()).inverse();
      move.scale_ratio = kGrowth;
      moved.keyframes.push_back(move);
    }
    return moved;
  }

 private:
  bool has_moved_ = false;
};

struct Outcome {
  Run run;
  /// Frame during which the past moved.
  int moved_at = -1;
};

// Tracks the first frames of the sweep; with `folder`, into its recovery log, and is killed then.
Outcome track(int frames, bool moves, const std::string& folder = {}) {
  const auto log = std::make_shared<MapLog>();
  OdometryParams params;
  params.camera.refine = "none";
  OdometryOptions options;
  options.map_log = log;
  if (moves) options.move_map = MoveOnce();
  std::optional<RunOutputs> outputs;
  if (!folder.empty()) {
    RecoveryHeader header;
    RunParams all;
    header.info.camera = test::sweep_camera();
    header.info.params_yaml = write_params([&](ParamVisitor& v) { all.visit(v); });
    outputs.emplace(folder, test::sweep_camera(), MapParams());
    outputs->keep_recovery_log(header, log);
  }
  MapCursor events(log);
  Odometry odometry(test::sweep_camera(), params, options);
  Outcome outcome;
  for (int i = 0; i < frames; ++i) {
    const Frame frame = test::sweep_frame(i);
    const FrameRecord record = odometry.process(frame);
    if (outputs && !outputs->add_frame(frame)) std::_Exit(1);
    if (outputs) outputs->add_record(record);
    for (const auto& event : events.read())
      if (std::holds_alternative<MapMoved>(*event)) outcome.moved_at = i;
  }
  if (outputs) std::raise(SIGKILL);
  outcome.run = odometry.finish();
  return outcome;
}

// Runs `track` in a program of its own and waits for its end.
int signal_of_killed(int frames, const std::string& folder) {
  cv::setNumThreads(
      1);  // as the program: the child would wait for threads of a pool that fork() leaves behind
  const pid_t child = fork();
  if (child == 0) {
    track(frames, true, folder);
    std::_Exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

// Distance between the first and the last keyframe that moves.
double length(const Run& run) {
  return (run.keyframes[kMovedWith - 1].T_world_cam.translation() -
          run.keyframes[0].T_world_cam.translation())
      .norm();
}

TEST(KilledRun, IsRecoveredWithThePastThatHadMoved) {
  const Outcome ended = track(kFrames, true), unmoved = track(kFrames, false);
  ASSERT_GE(ended.moved_at, 20) << "the past has moved";
  EXPECT_EQ(unmoved.moved_at, -1);
  EXPECT_NEAR(length(ended.run), kGrowth * length(unmoved.run), 1e-6);
  // Right after the move, in the midst of what follows, and later.
  for (const int frames : {ended.moved_at + 1, ended.moved_at + 2, kFrames}) {
    const test::TempFolder folder;
    ASSERT_EQ(signal_of_killed(frames, folder / "out"), SIGKILL);
    const edgevo::Run recovered = recover_run(folder / "out").run;
    EXPECT_GT(recovered.keyframes.size(), kMovedWith);
    test::expect_same_map(recovered, track(frames, true).run);
  }
}

}  // namespace
}  // namespace edgevo
