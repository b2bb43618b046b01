// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_loop/latency_stats.h"

namespace edgevo {
namespace {
constexpr double kLateS = 1e-3;  // threshold of RealtimeRecord::late
}

void LatencyStats::note_dropped() {
  latency_ms_.emplace_back();
  ++sums_.dropped;
}

void LatencyStats::note_done(double due_s, double delivered_s, double done_s) {
  if (sums_.delivered++ == 0) begin_s_ = due_s;
  sums_.late += delivered_s - due_s > kLateS;
  sums_.frames_per_second = sums_.delivered / (done_s - begin_s_);
  latency_ms_.emplace_back(1000 * (done_s - due_s));
}

void LatencyStats::write_to(Run* run) const {
  for (size_t i = 0; i < latency_ms_.size(); ++i) run->frames[i].latency_ms = latency_ms_[i];
  RealtimeRecord record = sums_;
  if (run->realtime) record.left_out_of_mapping = run->realtime->left_out_of_mapping;
  run->realtime = record;
}

}  // namespace edgevo
