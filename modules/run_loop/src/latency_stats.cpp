// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_loop/latency_stats.h"

#include <algorithm>

namespace edgevo {
namespace {
constexpr double kLateS = 1e-3;  // threshold of RealtimeRecord::late
}

void LatencyStats::add(std::optional<double> latency_ms) {
  latency_ms_.push_back(latency_ms);
  if (most_ > 0 && latency_ms_.size() > most_) latency_ms_.pop_front();
}

void LatencyStats::note_dropped() {
  add(std::nullopt);
  ++sums_.dropped;
}

void LatencyStats::note_done(double due_s, double delivered_s, double done_s) {
  if (sums_.delivered++ == 0) begin_s_ = due_s;
  sums_.late += delivered_s - due_s > kLateS;
  sums_.frames_per_second = sums_.delivered / (done_s - begin_s_);
  add(1000 * (done_s - due_s));
}

void LatencyStats::write_to(Run* run) const {
  // The run holds the newest frames, or all.
  const size_t first = latency_ms_.size() - std::min(latency_ms_.size(), run->frames.size());
  for (size_t i = first; i < latency_ms_.size(); ++i) run->frames[i - first].latency_ms = latency_ms_[i];
  RealtimeRecord record = sums_;
  if (run->realtime) {
    record.skipped_by_mapping = run->realtime->skipped_by_mapping;
    record.shed = run->realtime->shed;
  }
  run->realtime = record;
}

}  // namespace edgevo
