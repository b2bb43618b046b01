// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/trace.h"

#include <time.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

#include "edgevo/core/output_file.h"
#include "edgevo/core/thread_clock.h"

namespace edgevo {
namespace {

struct Scope {
  const char* name;
  int64_t begin_ns, end_ns;
  float cpu_ms;
  int frame, keyframe;
};

// The scopes of one thread: a ring of the newest ones. The lock is free except while the trace is written.
struct Lane {
  std::mutex mutex;
  const char* name = nullptr;
  std::vector<Scope> scopes;
  size_t count = 0;  // of all scopes, kept or not

  void add(const Scope& scope) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (scopes.size() < kMaxTracedScopes)
      scopes.push_back(scope);
    else
      scopes[count % kMaxTracedScopes] = scope;
    ++count;
  }
};

struct Lanes {
  std::mutex mutex;
  std::vector<std::shared_ptr<Lane>> all;
  int64_t begin_ns = 0;
};

// Never destroyed: threads may end after main().
Lanes& lanes() {
  static Lanes* const the_lanes = new Lanes;
  return *the_lanes;
}

// A thread that was traced before keeps its lane.
Lane& own_lane() {
  thread_local std::shared_ptr<Lane> lane;
  if (!lane) {
    lane = std::make_shared<Lane>();
    const std::lock_guard<std::mutex> lock(lanes().mutex);
    lanes().all.push_back(lane);
  }
  return *lane;
}

thread_local int frame_of_thread = -1;

void append_text(std::string* json, const char* text) {
  *json += '"';
  for (; *text; ++text) {
    if (*text == '"' || *text == '\\') *json += '\\';
    *json += *text;
  }
  *json += '"';
}

void append_scope(std::string* json, const Scope& s, int64_t begin_ns, size_t lane) {
  *json += ",\n{\"ph\":\"X\",\"pid\":1,\"tid\":" + std::to_string(lane) + ",\"name\":";
  append_text(json, s.name);
  *json += ",\"ts\":";
  append_fixed(json, 1e-3 * double(s.begin_ns - begin_ns), 3);
  *json += ",\"dur\":";
  append_fixed(json, 1e-3 * double(s.end_ns - s.begin_ns), 3);
  *json += ",\"args\":{\"cpu_ms\":";
  append_fixed(json, double(s.cpu_ms), 3);
  if (s.frame >= 0) *json += ",\"frame\":" + std::to_string(s.frame);
  if (s.keyframe >= 0) *json += ",\"keyframe\":" + std::to_string(s.keyframe);
  *json += "}}";
}

void append_lane(std::string* json, Lane* lane, int64_t begin_ns, size_t number) {
  const std::lock_guard<std::mutex> lock(lane->mutex);
  *json += ",\n{\"ph\":\"M\",\"pid\":1,\"tid\":" + std::to_string(number) +
           ",\"name\":\"thread_name\",\"args\":{\"name\":";
  append_text(json, lane->name ? lane->name : "thread");
  *json += "}}";
  const size_t oldest = lane->count > lane->scopes.size() ? lane->count % kMaxTracedScopes : 0;
  std::rotate(lane->scopes.begin(), lane->scopes.begin() + std::ptrdiff_t(oldest), lane->scopes.end());
  for (const Scope& s : lane->scopes) append_scope(json, s, begin_ns, number);
  lane->scopes = {};
  lane->count = 0;
}

}  // namespace

namespace trace_detail {
std::atomic<bool> is_on{false};

int64_t now_ns() {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return int64_t(t.tv_sec) * 1000000000 + t.tv_nsec;
}
}  // namespace trace_detail

void begin_trace() {
  end_trace();
  lanes().begin_ns = trace_detail::now_ns();
  trace_detail::is_on = true;
}

std::string end_trace() {
  trace_detail::is_on = false;
  const std::lock_guard<std::mutex> lock(lanes().mutex);
  std::string json =
      "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n{\"ph\":\"M\",\"pid\":1,\"tid\":0,\"name\":"
      "\"process_name\",\"args\":{\"name\":\"edgevo\"}}";
  size_t number = 0;
  for (const std::shared_ptr<Lane>& lane : lanes().all)
    append_lane(&json, lane.get(), lanes().begin_ns, ++number);
  // Those of threads that have ended.
  auto& all = lanes().all;
  all.erase(std::remove_if(all.begin(), all.end(), [](const auto& lane) { return lane.use_count() == 1; }),
            all.end());
  return json + "\n]}\n";
}

void name_traced_thread(const char* name) {
  if (!trace_detail::is_on) return;
  Lane& lane = own_lane();
  const std::lock_guard<std::mutex> lock(lane.mutex);
  if (!lane.name) lane.name = name;
}

void TraceScope::begin(const char* name, int frame, int keyframe) {
  name_ = name;
  outer_frame_ = frame_of_thread;
  frame_ = frame_of_thread = frame >= 0 ? frame : outer_frame_;
  keyframe_ = keyframe;
  begin_cpu_ms_ = thread_cpu_ms();
  begin_ns_ = trace_detail::now_ns();
}

void TraceScope::end() {
  frame_of_thread = outer_frame_;
  if (!trace_detail::is_on) return;
  const int64_t end_ns = trace_detail::now_ns();
  own_lane().add({name_, begin_ns_, end_ns, float(thread_cpu_ms() - begin_cpu_ms_), frame_, keyframe_});
}

}  // namespace edgevo
