// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/run_statistics.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/output_file.h"
#include "edgevo/run_quality/guessed_places.h"

namespace edgevo {
namespace {

int frames_in_guessed_places(const Run& run) {
  const std::vector<GuessedPlace> guessed = guessed_places(run);
  const auto is_guessed = [&](const FrameRecord& frame) {
    return std::any_of(guessed.begin(), guessed.end(), [&](const GuessedPlace& g) {
      return frame.index >= g.first_frame && frame.index <= g.last_frame;
    });
  };
  return int(std::count_if(run.frames.begin(), run.frames.end(), [&](const FrameRecord& frame) {
    return frame.T_world_cam && !is_doubtful(frame) && is_guessed(frame);
  }));
}

}  // namespace

RunCounts count(const Run& run) {
  RunCounts counts;
  counts.frames = int(run.frames.size());
  for (const FrameRecord& frame : run.frames) {
    counts.with_pose += frame.T_world_cam.has_value();
    counts.lost += frame.state == TrackingState::kLost;
    counts.doubtful += is_doubtful(frame);
    counts.segments = std::max(counts.segments, frame.segment + 1);
  }
  counts.guessed = frames_in_guessed_places(run);
  counts.keyframes = int(run.keyframes.size());
  for (const KeyframeRecord& keyframe : run.keyframes) {
    counts.doubtful_keyframes += keyframe.is_doubtful;
    counts.points += keyframe.points.size();
    counts.lines += keyframe.lines.size();
  }
  return counts;
}

std::vector<std::pair<std::string, std::vector<double>>> stage_times(const Run& run) {
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  for (const FrameRecord& frame : run.frames)
    for (const auto& [name, ms] : frame.stage_ms) {
      auto stage =
          std::find_if(stages.begin(), stages.end(), [&, &n = name](const auto& s) { return s.first == n; });
      if (stage == stages.end()) stage = stages.insert(stages.end(), {name, {}});
      stage->second.push_back(ms);
    }
  return stages;
}

std::vector<std::string> stages_of(const Run& run) {
  std::vector<std::string> names;
  for (const auto& stage : stage_times(run)) names.push_back(stage.first);
  return names;
}

std::vector<double> total_ms(const Run& run) {
  std::vector<double> totals;
  for (const FrameRecord& f : run.frames) {
    totals.push_back(0);
    for (const auto& stage : f.stage_ms) totals.back() += stage.second;
  }
  return totals;
}

double percentile(const std::vector<double>& sorted, double share) {
  const auto rank = size_t(std::ceil(share * double(sorted.size())));
  return sorted[std::max<size_t>(rank, 1) - 1];
}

std::optional<LatencyFigures> latency_figures(std::vector<double> ms) {
  if (ms.empty()) return std::nullopt;
  std::sort(ms.begin(), ms.end());
  return LatencyFigures{percentile(ms, 0.5), percentile(ms, 0.95), percentile(ms, 0.99), ms.back()};
}

std::optional<LatencyFigures> latency_figures(const Run& run) {
  std::vector<double> ms;
  for (const FrameRecord& frame : run.frames)
    if (frame.latency_ms) ms.push_back(*frame.latency_ms);
  return latency_figures(std::move(ms));
}

namespace {

std::string shed_statement(const ShedWork& shed) {
  if (shed.lines == 0 && shed.depths == 0 && shed.points == 0) return "";
  return "; skipped to be in time: the lines of " + std::to_string(shed.lines) +
         " keyframes, the depths of " + std::to_string(shed.depths) + " frames, half the points of " +
         std::to_string(shed.points) + " keyframes";
}

}  // namespace

std::string latency_statement(const Run& run) {
  const std::optional<LatencyFigures> latency = latency_figures(run);
  if (!run.realtime || !latency) return "";
  const RealtimeRecord& r = *run.realtime;
  return "pace " + r.pace + "; reached " + fixed(r.frames_per_second, 1) +
         " frames/s; latency until the pose, ms: median " + fixed(latency->p50, 1) + ", 95 % " +
         fixed(latency->p95, 1) + ", 99 % " + fixed(latency->p99, 1) + ", max " + fixed(latency->max, 1) +
         "; " + std::to_string(r.late) + " of " + std::to_string(r.delivered) + " frames delivered late, " +
         std::to_string(r.dropped) + " dropped, " + std::to_string(r.skipped_by_mapping) +
         " not used for depths" + shed_statement(r.shed);
}

}  // namespace edgevo
