// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_loop/run_odometry.h"

#include <ctime>
#include <memory>

#include "edgevo/core/formatted.h"
#include "edgevo/core/trace.h"
#include "edgevo/datasets/live_feed.h"
#include "edgevo/map/map_log.h"
#include "edgevo/places/view_locator.h"
#include "edgevo/run_loop/gyro_feed.h"
#include "edgevo/run_loop/latency_stats.h"
#include "edgevo/scale/up_by_gravity.h"
#include "first_frames.h"
#include "first_look.h"
#include "lenient_source.h"
#include "load_control.h"

namespace edgevo {
namespace {

// CPU seconds that the process spends in `work`.
template <class Work>
double cpu_seconds(Work&& work) {
  const std::clock_t begin = std::clock();
  work();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

using OnFrame = std::function<bool(const ProcessedFrame&)>;
using Stop = std::function<bool()>;

// What the loop works with, from the first frame to the last.
struct RunLoop {
  LenientSource& source;
  Odometry& odometry;
  PastFollower& past;
  GyroFeed& gyro;
  const OdometryOptions& options;
  const Stop& stop;
  const OnFrame& on_frame;
  const std::function<FrameView()> view;
  RunResult* result;
};

// Skipped frames that are logged one by one.
constexpr int kMaxSaid = 10;

void log(const RunLoop& loop, const Frame& frame, const std::string& what) {
  if (loop.options.log) loop.options.log("frame " + std::to_string(frame.index) + ": " + what);
}

FrameRecord skip_bad_frame(const RunLoop& loop, const Frame& frame) {
  const std::string reason = loop.source.take_reason(frame.index);
  if (loop.result->skipped++ == 0) loop.result->first_skipped = reason;
  const std::string note = "left out: " + reason;
  if (loop.result->skipped <= kMaxSaid) log(loop, frame, note);
  if (loop.result->skipped == kMaxSaid) log(loop, frame, "further skipped frames are noted in frames.csv");
  return loop.odometry.skip(frame, note);
}

FrameRecord process(const RunLoop& loop, const Frame& frame) {
  if (frame.image.empty()) return skip_bad_frame(loop, frame);
  FrameRecord record;
  loop.result->cpu_s += cpu_seconds([&] {
    loop.gyro.feed_until(frame.time, &loop.odometry);
    record = loop.odometry.process(frame);
    loop.past.follow();
  });
  return record;
}

ProcessedFrame done(const RunLoop& loop, const Frame& frame, const FrameRecord& record) {
  return {frame, record, loop.view, loop.odometry.ego_mask()};
}

void feed(const RunLoop& loop, ImageSource& source) {
  while (!loop.stop()) {
    const std::optional<Frame> frame = source.next();
    if (!frame || !loop.on_frame(done(loop, *frame, process(loop, *frame)))) break;
  }
}

void skip_dropped(const RunLoop& loop, const FedFrame& fed, LatencyStats* latency) {
  for (const Frame& dropped : fed.dropped) {
    loop.odometry.skip(dropped, "dropped: the odometry was behind the camera");
    latency->note_dropped();
  }
  if (!fed.dropped.empty())
    log(loop, fed.frame,
        std::to_string(fed.dropped.size()) +
            " frame(s) before it dropped, the odometry is behind the camera");
}

// Drops a frame whose pose would come too late, else sheds what is to be shed from it on.
bool drop_or_shed(const RunLoop& loop, const FedFrame& fed, LoadControl* control, LatencyStats* latency) {
  const double late_s = fed.delivered_s - fed.due_s;
  loop.odometry.shed(control->next(late_s));
  if (fed.frame.image.empty() || !control->drops(late_s)) return false;
  loop.odometry.skip(fed.frame, "dropped: its pose would have come too late");
  latency->note_dropped();
  return true;
}

void feed_realtime(const RunLoop& loop, LiveFeed& feed, LatencyStats* latency) {
  LoadControl control;
  while (!loop.stop()) {
    const std::optional<FedFrame> fed = feed.next(loop.stop);
    if (!fed) break;
    skip_dropped(loop, *fed, latency);
    if (drop_or_shed(loop, *fed, &control, latency)) continue;
    const FrameRecord record = process(loop, fed->frame);
    if (fed->frame.image.empty())
      latency->note_skipped();
    else
      latency->note_done(fed->due_s, fed->delivered_s, feed.now_s());
    if (!loop.on_frame(done(loop, fed->frame, record))) break;
  }
}

// What the beginning shows of the camera, before the run begins.
void begin_with_camera(FirstFrames* first, const OdometryParams& params, const Stop& stop,
                       OdometryOptions* options) {
  options->camera = first_look(first, params, *options, stop);
  if (options->camera && options->log)
    options->log(formatted("the first frames show a rolling shutter of %.1f ms: all are processed with it",
                           1e3 * options->camera->applied.readout_s));
}

// Where there was no first look, and nobody said it: on a schedule, or without a gyro.
void say_found_shutter(const RunLoop& loop, double given_readout_s) {
  const CameraPosterior& camera = loop.result->run.camera;
  if (given_readout_s != 0 || loop.options.camera || !loop.options.log) return;
  if (camera.state_of(CameraNumber::kReadout) == CameraPosterior::State::kApplied)
    loop.options.log(
        formatted("a rolling shutter of %.1f ms was found on the way: camera.readout_s=%.4f makes it "
                  "known from the first frame on",
                  1e3 * camera.applied.readout_s, camera.applied.readout_s));
}

// What `work`, which takes frames from the source, throws; nothing once the caller has stopped the run.
template <class Work>
std::exception_ptr exception_of(const Stop& stop, Work&& work) {
  try {
    work();
  } catch (const std::exception&) {
    if (!stop()) return std::current_exception();
  }
  return nullptr;
}

}  // namespace

std::optional<UpEstimate> RunResult::up_by_gravity() const {
  if (!gyro.model) return std::nullopt;
  return edgevo::up_by_gravity(run, accelerations, *gyro.model);
}

RunResult run_odometry(ImageSource& source, const OdometryParams& params, const RunLoopOptions& requested,
                       const OnFrame& on_frame) {
  OdometryOptions options = requested.odometry;
  // Frames that arrive on their own schedule do not wait for the mapping: better an older map than a late
  // pose.
  if (source.is_live() || requested.pace.kind != Pace::Kind::kAtOnce) {
    options.max_frames_ahead = 3;
    options.on_schedule = true;
  }
  const Stop stop = requested.stop ? requested.stop : [] { return false; };
  name_traced_thread("tracking");
  if (!options.map_log) options.map_log = std::make_shared<MapLog>();
  RunResult result;
  FirstFrames first(source);
  if (takes_first_look(source, params, options))
    result.cpu_s += cpu_seconds([&] { begin_with_camera(&first, params, stop, &options); });
  if (!options.locate && !options.forget) options.locate = locate_in(requested.past.kept);
  PastFollower past(source.camera(), source.T_vehicle_cam(), options, requested.past);
  Odometry odometry(source.camera(), params, options);
  LenientSource lenient(first);
  ImageSource& frames =
      requested.on_bad_frame == OnBadFrame::kSkip ? static_cast<ImageSource&>(lenient) : first;
  GyroFeed gyro(source.gyro_readings());
  const RunLoop loop{
      lenient, odometry, past, gyro, options, stop, on_frame, [&] { return odometry.frame_view(); }, &result};
  const auto finish = [&] {
    result.gyro = odometry.gyro();
    result.accelerations = gyro.take_accelerations();
    if (const std::string mismatch = gyro.mismatch(); !mismatch.empty()) result.gyro.statement = mismatch;
    result.cpu_s += cpu_seconds([&] {
      odometry.close();
      result.places = past.finish();
      result.run = odometry.finish();
    });
    say_found_shutter(loop, params.camera.readout_s);
  };
  if (options.realtime) {
    LiveFeed live_feed(frames, requested.pace);
    constexpr size_t kKept = 2000;  // frames
    LatencyStats latency(source.is_live() ? "that of the camera" : describe(requested.pace));
    if (options.forget) latency.forget_all_but(kKept);
    result.broken = exception_of(stop, [&] { feed_realtime(loop, live_feed, &latency); });
    finish();
    latency.write_to(&result.run);
  } else {
    result.broken = exception_of(stop, [&] { feed(loop, frames); });
    finish();
  }
  result.run.T_vehicle_cam = source.T_vehicle_cam();
  return result;
}

}  // namespace edgevo
