// SPDX-License-Identifier: BSD-3-Clause
// Frames that arrive on a schedule while a map is being made are answered without a pose and replayed later.
// Their poses are those of a run that takes all the time it needs, on the same images.
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <set>
#include <thread>

#include "edgevo/core/angle.h"
#include "unit/odometry/rendered_runs.h"

namespace edgevo {
namespace {

constexpr int kFramesOfRun = 80;

// A run on a schedule, and the frames that came while a map was being made.
struct ScheduledRun {
  edgevo::Run run;
  std::set<int> late;
};

// Up to `burst` frames come at once while a map is made; all others once there has been time to take the one
// before, on a machine of any speed.
ScheduledRun run_on_schedule(int burst) {
  OdometryOptions options;
  options.realtime = options.on_schedule = true;
  options.max_frames_ahead = 3;
  Odometry odometry(test::sweep_camera(), OdometryParams(), options);
  ScheduledRun scheduled;
  int at_once = 0;
  for (int k = 0; k < kFramesOfRun; ++k) {
    const FrameRecord record = odometry.process(test::sweep_frame(k));
    const bool is_late = record.note.find("a map is being made") != std::string::npos;
    if (is_late) scheduled.late.insert(k);
    if (is_late && ++at_once < burst) continue;
    if (!record.T_world_cam_live) std::this_thread::sleep_for(std::chrono::milliseconds(150));
  }
  scheduled.run = odometry.finish();
  return scheduled;
}

// The runs that both tests look at.
const ScheduledRun& scheduled_run(int burst) {
  static std::map<int, ScheduledRun> runs;
  if (!runs.count(burst)) runs[burst] = run_on_schedule(burst);
  return runs[burst];
}

const edgevo::Run& synchronous_run() {
  static const edgevo::Run run = test::run_sweep(kFramesOfRun);
  return run;
}

using Poses = std::map<int, SE3>;

Poses poses_of(const edgevo::Run& run) {
  Poses poses;
  for (const FrameRecord& f : run.frames)
    if (f.T_world_cam) poses[f.index] = *f.T_world_cam;
  return poses;
}

// Two maps have two worlds and units: from b to a, by the frames that are not `late`.
Eigen::Matrix4d similarity(const Poses& a, const Poses& b, const std::set<int>& late) {
  std::vector<Eigen::Vector3d> in_a, in_b;
  for (const auto& [index, T] : b)
    if (a.count(index) && !late.count(index))
      in_a.push_back(a.at(index).translation()), in_b.push_back(T.translation());
  Eigen::Matrix3Xd A(3, long(in_a.size())), B = A;
  for (size_t i = 0; i < in_a.size(); ++i) A.col(long(i)) = in_a[i], B.col(long(i)) = in_b[i];
  return Eigen::umeyama(B, A, true);
}

double length_of(const Poses& poses) {
  double length = 0;
  for (auto next = std::next(poses.begin()); next != poses.end(); ++next)
    length += (next->second.translation() - std::prev(next)->second.translation()).norm();
  return length;
}

// The largest differences over the late frames. Position: over the length of the path. Rotation: since the
// first frame after them.
struct PoseDifference {
  int frames = 0;
  double position = 0, rotation_deg = 0;
};

PoseDifference difference_of_replayed(const Poses& a, const Poses& b, const std::set<int>& late) {
  const Eigen::Matrix4d S = similarity(a, b, late);
  const int after = *late.rbegin() + 1;
  PoseDifference largest;
  for (const int index : late) {
    if (!a.count(index) || !b.count(index)) continue;
    ++largest.frames;
    const Eigen::Vector3d at = (S * b.at(index).translation().homogeneous()).head<3>();
    largest.position = std::max(largest.position, (at - a.at(index).translation()).norm() / length_of(a));
    const SE3 in_a = a.at(after).inverse() * a.at(index), in_b = b.at(after).inverse() * b.at(index);
    largest.rotation_deg =
        std::max(largest.rotation_deg, deg(in_a.rotation().angularDistance(in_b.rotation())));
  }
  return largest;
}

// Measured over eight runs: at most 0.73 % and 0.25 degrees. Another seed of the synchronous run differs by
// 0.6 % and 0.26 degrees: two maps of other views, each with a drift of its own.
constexpr double kPosition = 0.02, kRotationDeg = 0.6;

// More may wait than are kept where making a map takes long, and the oldest get none.
size_t least_with_pose(const std::set<int>& late) { return std::min<size_t>(late.size(), 20); }

class FrameBuffer : public ::testing::TestWithParam<int> {};

TEST_P(FrameBuffer, GetThePosesOfASynchronousRun) {
  const ScheduledRun& scheduled = scheduled_run(GetParam());
  ASSERT_FALSE(scheduled.late.empty()) << "a map takes longer than a frame";
  const PoseDifference d =
      difference_of_replayed(poses_of(synchronous_run()), poses_of(scheduled.run), scheduled.late);
  EXPECT_GE(size_t(d.frames), least_with_pose(scheduled.late));
  EXPECT_LT(d.position, kPosition);
  EXPECT_LT(d.rotation_deg, kRotationDeg);
}

TEST_P(FrameBuffer, AreLabelledAsThoseThatWereFollowedInTime) {
  const ScheduledRun& scheduled = scheduled_run(GetParam());
  for (const int index : scheduled.late) {
    const FrameRecord& f = scheduled.run.frames[size_t(index)];
    if (!f.T_world_cam) continue;
    EXPECT_EQ(f.segment, 0) << index;
    EXPECT_EQ(f.state, TrackingState::kTracking) << index << ": " << f.note;
    EXPECT_GT(f.p_right, 0.9) << index;
    EXPECT_FALSE(f.covariance.isZero()) << index;
    EXPECT_GT(f.evidence.inlier_share, 0.5) << index;
  }
}

INSTANTIATE_TEST_SUITE_P(AtOnce, FrameBuffer, ::testing::Values(4, 14));

}  // namespace
}  // namespace edgevo
