// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/frame_evaluation/reported_frame.h"

#include <filesystem>
#include <map>

#include "csv_table.h"
#include "edgevo/core/error.h"
#include "edgevo/evaluation/trajectory.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy = "give the folder of a finished run";

TrackingState parse_state(std::string_view text, const std::string& where) {
  for (const TrackingState state : {TrackingState::kBootstrapping, TrackingState::kTracking,
                                    TrackingState::kDegraded, TrackingState::kLost})
    if (text == to_string(state)) return state;
  throw InputError(where, "'" + std::string(text) + "' is no state", kRemedy);
}

// By ticks. A run without poses leaves a file without lines, which read_trajectory() refuses.
std::map<int64_t, SE3> poses_in(const std::string& path) {
  std::map<int64_t, SE3> poses;
  std::optional<Trajectory> trajectory;
  try {
    trajectory = read_trajectory(path);
  } catch (const InputError& e) {
    if (std::string(e.what()).find("contains no pose") == std::string::npos) throw;
    return poses;
  }
  for (const StampedPose& p : trajectory->poses) poses.emplace(p.time.ticks, p.T_world_cam);
  return poses;
}

ReportedFrame reported_in(const CsvTable& row) {
  ReportedFrame frame;
  frame.index = int(row.number("index"));
  if (!parse_seconds(row.text("time"), &frame.time))
    throw InputError(row.where(), "the time is not a number of seconds", kRemedy);
  frame.state = parse_state(row.text("state"), row.where());
  frame.segment = int(row.number("segment"));
  frame.p_right = row.number("p_right", true);
  frame.median_depth = row.number("median_depth", true);
  return frame;
}

std::map<int, int> positions_of(const std::vector<ReportedFrame>& reported) {
  std::map<int, int> position;
  for (size_t i = 0; i < reported.size(); ++i) position[reported[i].index] = int(i);
  return position;
}

int position_of(const std::map<int, int>& positions, int index) {
  const auto known = positions.find(index);
  return known == positions.end() ? -1 : known->second;
}

void read_covariances(const std::string& path, std::vector<ReportedFrame>* reported) {
  const std::map<int, int> positions = positions_of(*reported);
  CsvTable table(path, kRemedy);
  while (table.next()) {
    const int at = position_of(positions, int(table.number("index")));
    if (at < 0) continue;
    ReportedFrame& frame = (*reported)[size_t(at)];
    frame.reference = position_of(positions, int(table.number("reference")));
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j)
        frame.covariance(i, j) = frame.covariance(j, i) =
            table.number("c" + std::to_string(i) + std::to_string(j));
  }
}

}  // namespace

std::vector<ReportedFrame> reported_frames(const Run& run, PoseSource poses) {
  std::vector<ReportedFrame> reported;
  reported.reserve(run.frames.size());
  for (const FrameRecord& f : run.frames) {
    ReportedFrame& frame = reported.emplace_back();
    frame.index = f.index, frame.time = f.time, frame.state = f.state, frame.segment = f.segment;
    frame.p_right = f.p_right, frame.median_depth = f.evidence.median_depth;
    const std::optional<SE3>& T = poses == PoseSource::kLive ? f.T_world_cam_live : f.T_world_cam;
    if (T && T->is_finite()) frame.T_world_cam = T;
    frame.covariance = f.covariance;
  }
  const std::map<int, int> positions = positions_of(reported);
  for (size_t i = 0; i < reported.size(); ++i)
    if (const int k = run.frames[i].reference_keyframe; k >= 0)
      reported[i].reference = position_of(positions, run.keyframes[size_t(k)].frame_index);
  return reported;
}

std::vector<ReportedFrame> read_reported_frames(const std::string& folder, PoseSource poses) {
  const auto in = [&](const char* name) { return (fs::path(folder) / name).string(); };
  const std::map<int64_t, SE3> pose_at =
      poses_in(in(poses == PoseSource::kLive ? "trajectory_live_tum.txt" : "trajectory_tum.txt"));
  std::vector<ReportedFrame> reported;
  CsvTable table(in("frames.csv"), kRemedy);
  while (table.next()) {
    reported.push_back(reported_in(table));
    const auto pose = pose_at.find(reported.back().time.ticks);
    if (pose != pose_at.end()) reported.back().T_world_cam = pose->second;
  }
  std::error_code ignored;
  if (fs::exists(in("covariances.csv"), ignored)) read_covariances(in("covariances.csv"), &reported);
  return reported;
}

}  // namespace edgevo
