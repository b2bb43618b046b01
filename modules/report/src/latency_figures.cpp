#include "edgevo/report/latency_figures.h"

#include <algorithm>

#include "edgevo/core/output_file.h"
#include "edgevo/report/stage_times.h"

namespace edgevo {

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

std::string latency_statement(const Run& run) {
  const std::optional<LatencyFigures> latency = latency_figures(run);
  if (!run.realtime || !latency) return "";
  const RealtimeRecord& r = *run.realtime;
  return "pace " + r.pace + "; reached " + fixed(r.frames_per_second, 1) +
         " frames/s; latency until the pose, ms: median " + fixed(latency->p50, 1) + ", 95 % " +
         fixed(latency->p95, 1) + ", 99 % " + fixed(latency->p99, 1) + ", max " + fixed(latency->max, 1) +
         "; " + std::to_string(r.late) + " of " + std::to_string(r.handed_over) +
         " frames handed over late, " + std::to_string(r.dropped) + " dropped, " +
         std::to_string(r.left_out_of_mapping) + " not used for depths";
}

}  // namespace edgevo
