// SPDX-License-Identifier: BSD-3-Clause
#include "advice.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "edgevo/core/output_file.h"
#include "edgevo/run_quality/doubtful_intervals.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/run_quality/run_warnings.h"

namespace edgevo {
namespace {

int frames_in(const Run& run, TrackingState state) {
  return int(
      std::count_if(run.frames.begin(), run.frames.end(), [&](const auto& f) { return f.state == state; }));
}

// The most frequent note among frames of a state, including its numbers.
std::string commonest_note(const Run& run, TrackingState state) {
  std::map<std::string, int> count;
  for (const FrameRecord& f : run.frames)
    if (f.state == state && !f.note.empty()) ++count[f.note];
  const auto most = std::max_element(count.begin(), count.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == count.end() ? "" : most->first;
}

// An absolute path, since commands are run from the folder of the report. Anything that is not a path
// (camera:0) is returned unchanged.
std::string from_anywhere(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(path, error)
             ? std::filesystem::absolute(path, error).lexically_normal().string()
             : path;
}

std::string because(const std::string& note) { return note.empty() ? "" : " (\"" + note + "\")"; }

void add_troubles(const Run& run, const RunInfo& info, std::vector<Advice>* list) {
  const int frames = int(run.frames.size()), lost = frames_in(run, TrackingState::kLost),
            degraded = frames_in(run, TrackingState::kDegraded);
  if (info.interrupted) list->push_back({"The run ended early; this is the part up to there.", ""});
  if (count(run).with_pose == 0)
    list->push_back({"No frame has a pose" + because(commonest_note(run, TrackingState::kBootstrapping)) +
                         ". The camera must translate, not only rotate, in view of objects with edges; "
                         "check also that the calibration belongs to these images.",
                     ""});
  else if (2 * count(run).with_pose < frames)
    list->push_back(
        {"Less than half of the frames have a pose: see the states below and the notes in frames.csv.", ""});
  if (count(run).with_pose > 0 && lost > 0)
    list->push_back({std::to_string(lost) + " frames are lost" +
                         because(commonest_note(run, TrackingState::kLost)) +
                         ". Position and scale of a new segment are a guess. Images at a higher rate or with "
                         "a shorter exposure help most; look at the images of the red intervals.",
                     ""});
  if (10 * degraded > frames)
    list->push_back({std::to_string(degraded) + " frames are degraded" +
                         because(commonest_note(run, TrackingState::kDegraded)) +
                         ": use their poses with the covariance in playback.rawlog.",
                     ""});
}

// The intervals that are not to be trusted, the longest of them.
void add_doubtful(const Run& run, std::vector<Advice>* list) {
  constexpr size_t kShown = 10;
  const std::vector<DoubtfulInterval> all = doubtful_intervals(run);
  for (const DoubtfulInterval& interval : longest(all, kShown))
    list->push_back({"NOT TO BE TRUSTED: " + to_string(interval), ""});
  if (all.size() > kShown)
    list->push_back({"And " + std::to_string(all.size() - kShown) + " shorter intervals: summary.yaml.", ""});
}

void add_camera(const Run& run, const RunInfo& info, std::vector<Advice>* list) {
  if (run.camera.state_of(CameraNumber::kK1) == CameraPosterior::State::kApplied && info.camera.plumb_bob())
    list->push_back(
        {"The camera file does not cover all of the lens distortion; write a camera file with the correction "
         "that was found:",
         "edgevo calibrate . -o camera.yaml"});
}

void add_scale(const Run& run, const RunInfo& info, std::vector<Advice>* list) {
  if (run.is_metric() || count(run).with_pose == 0) return;
  list->push_back(
      {"Lengths are in an arbitrary unit. For metres, give a source of scale (edgevo run --help lists them), "
       "for example",
       "edgevo run " + from_anywhere(info.source_path) + " -o OUT --scale factor=METRES_PER_UNIT"});
}

// Adds a hint if the odometry was slower than the camera, on average over the run.
void add_speed(const Run& run, std::vector<Advice>* list) {
  if (run.frames.size() < 10) return;
  double busy_ms = 0;
  for (const auto& stage : stage_times(run))
    for (double ms : stage.second) busy_ms += ms;
  const double span_ms = 1000 * seconds_between(run.frames.front().time, run.frames.back().time);
  if (busy_ms <= span_ms) return;
  list->push_back({"The odometry takes " + fixed(busy_ms / double(run.frames.size()), 0) +
                       " ms a frame, but images arrive every " +
                       fixed(span_ms / double(run.frames.size() - 1), 0) +
                       " ms: for live use, take two threads (--realtime), smaller images or every second "
                       "image (--every 2).",
                   ""});
}

void add_uses(const Run& run, const RunInfo& info, std::vector<Advice>* list) {
  if (count(run).with_pose == 0) return;
  if (!info.ground_truth_path.empty())
    list->push_back({"All error figures, compared with ground truth:",
                     "edgevo eval trajectory_tum.txt " + from_anywhere(info.ground_truth_path)});
  list->push_back({"The path and the edges in 3D:", "SceneViewer3D scene.3Dscene"});
  list->push_back(
      {"Images, poses and points frame by frame (start it in this folder):", "RawLogViewer playback.rawlog"});
  list->push_back({"The map for planners (octomap_server, MoveIt, FCL):", "octovis edges.bt"});
}

}  // namespace

std::vector<Advice> advise(const Run& run, const RunInfo& info) {
  std::vector<Advice> list;
  for (const std::string& warning : input_warnings(info.input)) list.push_back({"WARNING: " + warning, ""});
  for (const std::string& warning : run_warnings(run)) list.push_back({"WARNING: " + warning, ""});
  add_doubtful(run, &list);
  add_troubles(run, info, &list);
  add_camera(run, info, &list);
  add_scale(run, info, &list);
  add_speed(run, &list);
  add_uses(run, info, &list);
  return list;
}

}  // namespace edgevo
