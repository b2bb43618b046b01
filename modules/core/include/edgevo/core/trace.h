// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A trace of a run: what each thread did, and when, in the trace-event format of Chrome that trace viewers
// (Perfetto, chrome://tracing, Speedscope) open.
//
// One trace per process, off at first. Each thread writes to a buffer of its own, without a lock; a scope
// costs about a microsecond while the trace is on, and a load and a branch while it is off.
#include <atomic>
#include <cstdint>
#include <string>

namespace edgevo {

namespace trace_detail {
/// Whether a trace is being recorded.
extern std::atomic<bool> is_on;
/// Time since an arbitrary moment.
int64_t now_ns();
}  // namespace trace_detail

/// Begins a trace; what an earlier one has recorded is forgotten.
void begin_trace();
/// Ends the trace and returns it as JSON: one complete event for each scope that has ended, one lane for each
/// thread. Scopes that other threads have not left by then are missing. The result is a whole document at any
/// time, also after an interruption.
std::string end_trace();
/// Number of scopes that a thread keeps: its newest ones, some hours of a run.
constexpr size_t kMaxTracedScopes = size_t(1) << 20;

/// Names the lane of the calling thread; `name` is a literal. The first name stays.
void name_traced_thread(const char* name);

/// A stage of the work: from the construction to the destruction, in the calling thread. Events carry the
/// time on the clock, and the CPU time of the thread in `cpu_ms`.
class TraceScope {
 public:
  /// `name` is a literal. A frame or keyframe (its index, its id) goes into the event's arguments if it is
  /// not negative; a scope without a frame has that of the scope around it.
  explicit TraceScope(const char* name, int frame = -1, int keyframe = -1) {
    if (trace_detail::is_on.load(std::memory_order_relaxed)) begin(name, frame, keyframe);
  }
  ~TraceScope() {
    if (name_) end();
  }
  TraceScope(const TraceScope&) = delete;
  TraceScope& operator=(const TraceScope&) = delete;

  /// Gives the keyframe where it is known only later.
  void set_keyframe(int id) { keyframe_ = id; }

 private:
  void begin(const char* name, int frame, int keyframe);
  void end();

  const char* name_ = nullptr;
  int64_t begin_ns_ = 0;
  double begin_cpu_ms_ = 0;
  int frame_ = -1, keyframe_ = -1, outer_frame_ = -1;
};

}  // namespace edgevo
