// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/time_matching.h"

#include <algorithm>

#include "edgevo/core/error.h"
#include "time_steps.h"

namespace edgevo {
namespace {

// 0.1 ms: files may round times.
constexpr int64_t kEndToleranceTicks = Timestamp::kTicksPerSecond / 10'000;
// Longest gap to interpolate, median steps of the ground truth.
constexpr int kLongestGapSteps = 10;
constexpr size_t kMinMatches = 3;  // a similarity fits any two points exactly

SE3 interpolate(const StampedPose& a, const StampedPose& b, Timestamp time) {
  const double u = double(time.ticks - a.time.ticks) / double(b.time.ticks - a.time.ticks);
  const Eigen::Vector3d t = (1.0 - u) * a.T_world_cam.translation() + u * b.T_world_cam.translation();
  return {a.T_world_cam.rotation().slerp(u, b.T_world_cam.rotation()), t};
}

}  // namespace

GroundTruth::GroundTruth(const Trajectory& trajectory)
    : poses_(&trajectory.poses),
      longest_gap_ticks_(kLongestGapSteps * median_step_ticks(times_of(trajectory))) {}

std::optional<SE3> GroundTruth::at(Timestamp time) const {
  const auto after = std::lower_bound(poses_->begin(), poses_->end(), time,
                                      [](const StampedPose& p, Timestamp t) { return p.time < t; });
  if (after == poses_->end()) {
    if (time.ticks - poses_->back().time.ticks > kEndToleranceTicks) return std::nullopt;
    return poses_->back().T_world_cam;
  }
  if (after->time == time) return after->T_world_cam;
  if (after == poses_->begin()) {
    if (after->time.ticks - time.ticks > kEndToleranceTicks) return std::nullopt;
    return after->T_world_cam;
  }
  const auto before = std::prev(after);
  if (after->time.ticks - before->time.ticks > longest_gap_ticks_) return std::nullopt;
  return interpolate(*before, *after, time);
}

TimeMatches match_by_time(const Trajectory& estimate, const Trajectory& ground_truth,
                          const InputFrames& input) {
  const GroundTruth truth(ground_truth);
  TimeMatches result;
  result.frames.resize(input.times.size());
  const int64_t reach = median_step_ticks(input.times) / 2 + kEndToleranceTicks;
  for (const StampedPose& pose : estimate.poses) {
    const int frame = nearest_index(input.times, pose.time);
    const bool is_input = std::abs(pose.time.ticks - input.times[size_t(frame)].ticks) <= reach;
    if (is_input) result.frames[size_t(frame)].has_pose = true;
    const std::optional<SE3> T_gt = truth.at(pose.time);
    if (!T_gt) {
      ++result.without_ground_truth;
      continue;
    }
    if (is_input) {
      result.frames[size_t(frame)].match = int(result.matches.size());
      result.frames[size_t(frame)].T_gt = T_gt;
    }
    result.matches.push_back({pose.time, frame, pose.T_world_cam, *T_gt});
  }
  if (estimate.poses.size() < kMinMatches)
    throw InputError(estimate.path, "has only " + std::to_string(estimate.poses.size()) + " pose(s)",
                     "an evaluation needs " + std::to_string(kMinMatches));
  if (result.matches.size() < kMinMatches)
    throw InputError(estimate.path,
                     "only " + std::to_string(result.matches.size()) + " of its " +
                         std::to_string(estimate.poses.size()) + " poses lie within the times of " +
                         ground_truth.path,
                     "give the ground truth of the same sequence, in the same clock");
  for (size_t i = 0; i < result.frames.size(); ++i)
    if (!result.frames[i].T_gt) result.frames[i].T_gt = truth.at(input.times[i]);
  return result;
}

}  // namespace edgevo
