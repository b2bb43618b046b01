#include "edgevo/drive/drive.h"

#include <ctime>
#include <opencv2/core.hpp>

#include "edgevo/datasets/live_feed.h"
#include "edgevo/drive/keeping_up.h"

namespace edgevo {
namespace {

// CPU seconds of the process that `work` takes.
template <class Work>
double cpu_seconds(Work&& work) {
  const std::clock_t begin = std::clock();
  work();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

using OnFrame = std::function<bool(const DrivenFrame&)>;
using Stop = std::function<bool()>;

void feed(ImageSource& source, const Stop& stop, Odometry& odometry, const OnFrame& on_frame, Drive* drive) {
  while (!stop()) {
    const std::optional<Frame> frame = source.next();
    if (!frame) break;
    const FrameRecord* record = nullptr;
    drive->cpu_s += cpu_seconds([&] { record = &odometry.process(*frame); });
    if (!on_frame({*frame, *record, odometry})) break;
  }
}

void pass_over(const FedFrame& fed, const OdometryOptions& options, Odometry& odometry,
               KeepingUp* keeping_up) {
  for (const Frame& dropped : fed.dropped) {
    odometry.pass_over(dropped, "dropped: the odometry was behind the camera");
    keeping_up->note_dropped();
  }
  if (!fed.dropped.empty() && options.log)
    options.log("frame " + std::to_string(fed.frame.index) + ": " + std::to_string(fed.dropped.size()) +
                " frame(s) before it dropped, the odometry is behind the camera");
}

void feed_realtime(LiveFeed& feed, const OdometryOptions& options, const Stop& stop, Odometry& odometry,
                   const OnFrame& on_frame, KeepingUp* keeping_up, Drive* drive) {
  while (!stop()) {
    const std::optional<FedFrame> fed = feed.next(stop);
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
std::exception_ptr broken_by(const Stop& stop, Work&& work) {
  try {
    work();
  } catch (const std::exception&) {
    if (!stop()) return std::current_exception();
  }
  return nullptr;
}

}  // namespace

Drive drive(ImageSource& source, const OdometryParams& params, const DriveOptions& asked,
            const OnFrame& on_frame) {
  cv::setNumThreads(1);  // the threads are ours: tracking and mapping
  OdometryOptions options = asked.odometry;
  // Frames that come at their own time do not wait: better an older map than a late pose.
  if (source.is_live() || asked.pace.kind != Pace::Kind::kAtOnce) options.max_frames_ahead = 3;
  const Stop stop = asked.stop ? asked.stop : [] { return false; };
  Odometry odometry(source.camera(), params, options);
  Drive result;
  const auto finish = [&] { result.cpu_s += cpu_seconds([&] { result.run = odometry.finish(); }); };
  if (options.realtime) {
    LiveFeed live_feed(source, asked.pace);
    KeepingUp keeping_up(source.is_live() ? "that of the camera" : describe(asked.pace));
    result.broken = broken_by(
        stop, [&] { feed_realtime(live_feed, options, stop, odometry, on_frame, &keeping_up, &result); });
    finish();
    keeping_up.write_to(&result.run);
  } else {
    result.broken = broken_by(stop, [&] { feed(source, stop, odometry, on_frame, &result); });
    finish();
  }
  result.run.T_vehicle_cam = source.T_vehicle_cam();
  return result;
}

}  // namespace edgevo
