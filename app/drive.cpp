#include "drive.h"

#include <csignal>
#include <ctime>
#include <opencv2/core.hpp>

#include "edgevo/datasets/live_feed.h"
#include "run_outputs_latency.h"

namespace edgevo::app {
namespace {

volatile std::sig_atomic_t signalled = 0;
void on_signal(int) { signalled = 1; }

// CPU seconds of the process that `work` takes.
template <class Work>
double cpu_seconds(Work&& work) {
  const std::clock_t begin = std::clock();
  work();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

using OnFrame = std::function<bool(const DrivenFrame&)>;

void feed(ImageSource& source, Odometry& odometry, const OnFrame& on_frame, Drive* drive) {
  while (!interrupted()) {
    const std::optional<Frame> frame = source.next();
    if (!frame) break;
    const FrameRecord* record = nullptr;
    drive->cpu_s += cpu_seconds([&] { record = &odometry.process(*frame); });
    if (!on_frame({*frame, *record, odometry})) break;
  }
}

void pass_over(const FedFrame& fed, const OdometryOptions& options, Odometry& odometry, KeepingUp* keeping_up) {
  for (const Frame& dropped : fed.dropped) {
    odometry.pass_over(dropped, "dropped: the odometry was behind the camera");
    keeping_up->note_dropped();
  }
  if (!fed.dropped.empty() && options.log)
    options.log("frame " + std::to_string(fed.frame.index) + ": " + std::to_string(fed.dropped.size()) +
                " frame(s) before it dropped, the odometry is behind the camera");
}

void feed_realtime(LiveFeed& feed, const OdometryOptions& options, Odometry& odometry, const OnFrame& on_frame, KeepingUp* keeping_up,
                   Drive* drive) {
  while (!interrupted()) {
    const std::optional<FedFrame> fed = feed.next(interrupted);
    if (!fed) break;
    pass_over(*fed, options, odometry, keeping_up);
    const FrameRecord* record = nullptr;
    drive->cpu_s += cpu_seconds([&] { record = &odometry.process(fed->frame); });
    keeping_up->note_done(fed->due_s, fed->handed_s, feed.now_s());
    if (!on_frame({fed->frame, *record, odometry})) break;
  }
}

// `work` takes frames from the source until it ends, or breaks.
template <class Work>
std::exception_ptr broken_by(Work&& work) {
  try {
    work();
  } catch (const std::exception&) {
    // A signal ends a camera's wait for its next image, too.
    if (!interrupted()) return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void listen_to_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() { return signalled != 0; }

Drive drive(ImageSource& source, const OdometryParams& params, OdometryOptions options,
            const std::function<bool(const DrivenFrame&)>& on_frame, const Pace& pace) {
  cv::setNumThreads(1);  // the threads are ours: tracking and mapping
  // Frames that come at their own time do not wait: better an older map than a late pose.
  if (source.is_live() || pace.kind != Pace::Kind::kAtOnce) options.max_frames_ahead = 3;
  Odometry odometry(source.camera(), params, options);
  Drive result;
  const auto finish = [&] { result.cpu_s += cpu_seconds([&] { result.run = odometry.finish(); }); };
  if (options.realtime) {
    LiveFeed live_feed(source, pace);
    KeepingUp keeping_up(source.is_live() ? "that of the camera" : describe(pace));
    result.broken = broken_by([&] { feed_realtime(live_feed, options, odometry, on_frame, &keeping_up, &result); });
    finish();
    keeping_up.write_to(&result.run);
  } else {
    result.broken = broken_by([&] { feed(source, odometry, on_frame, &result); });
    finish();
  }
  result.run.T_vehicle_cam = source.T_vehicle_cam();
  return result;
}

}  // namespace edgevo::app
