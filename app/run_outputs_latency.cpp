#include "run_outputs_latency.h"

#include <algorithm>

#include "edgevo/core/output_file.h"
#include "run_outputs_stages.h"

namespace edgevo::app {
namespace {
constexpr double kLateS = 1e-3;  // RealtimeRecord::late
}

void KeepingUp::note_dropped() {
  latency_ms_.emplace_back();
  ++sums_.dropped;
}

void KeepingUp::note_done(double due_s, double handed_s, double done_s) {
  if (sums_.handed_over++ == 0) begin_s_ = due_s;
  sums_.late += handed_s - due_s > kLateS;
  sums_.frames_per_second = sums_.handed_over / (done_s - begin_s_);
  latency_ms_.emplace_back(1000 * (done_s - due_s));
}

void KeepingUp::write_to(Run* run) const {
  for (size_t i = 0; i < latency_ms_.size(); ++i) run->frames[i].latency_ms = latency_ms_[i];
  RealtimeRecord record = sums_;
  if (run->realtime) record.left_out_of_mapping = run->realtime->left_out_of_mapping;
  run->realtime = record;
}

std::optional<LatencyFigures> latency_figures(const Run& run) {
  std::vector<double> ms;
  for (const FrameRecord& frame : run.frames)
    if (frame.latency_ms) ms.push_back(*frame.latency_ms);
  if (ms.empty()) return std::nullopt;
  std::sort(ms.begin(), ms.end());
  return LatencyFigures{percentile(ms, 0.5), percentile(ms, 0.95), percentile(ms, 0.99), ms.back()};
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

}  // namespace edgevo::app
