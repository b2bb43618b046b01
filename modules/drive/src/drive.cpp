#include "edgevo/drive/drive.h"

#include <ctime>
#include <opencv2/core.hpp>

#include "edgevo/datasets/live_feed.h"
#include "edgevo/drive/keeping_up.h"
#include "lenient_source.h"

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

// What a drive works with, from its first frame to its last.
struct Course {
  LenientSource& source;
  Odometry& odometry;
  const OdometryOptions& options;
  const Stop& stop;
  const OnFrame& on_frame;
  Drive* drive;
};

void say(const Course& c, const Frame& frame, const std::string& what) {
  if (c.options.log) c.options.log("frame " + std::to_string(frame.index) + ": " + what);
}

const FrameRecord& leave_out(const Course& c, const Frame& frame) {
  const std::string reason = c.source.take_reason(frame.index);
  if (c.drive->left_out++ == 0) c.drive->first_left_out = reason;
  say(c, frame, "left out: " + reason);
  return c.odometry.pass_over(frame, "left out: " + reason);
}

const FrameRecord& process(const Course& c, const Frame& frame) {
  if (frame.image.empty()) return leave_out(c, frame);
  const FrameRecord* record = nullptr;
  c.drive->cpu_s += cpu_seconds([&] { record = &c.odometry.process(frame); });
  return *record;
}

void feed(const Course& c, ImageSource& source) {
  while (!c.stop()) {
    const std::optional<Frame> frame = source.next();
    if (!frame || !c.on_frame({*frame, process(c, *frame), c.odometry})) break;
  }
}

void pass_over(const Course& c, const FedFrame& fed, KeepingUp* keeping_up) {
  for (const Frame& dropped : fed.dropped) {
    c.odometry.pass_over(dropped, "dropped: the odometry was behind the camera");
    keeping_up->note_dropped();
  }
  if (!fed.dropped.empty())
    say(c, fed.frame,
        std::to_string(fed.dropped.size()) +
            " frame(s) before it dropped, the odometry is behind the camera");
}

void feed_realtime(const Course& c, LiveFeed& feed, KeepingUp* keeping_up) {
  while (!c.stop()) {
    const std::optional<FedFrame> fed = feed.next(c.stop);
    if (!fed) break;
    pass_over(c, *fed, keeping_up);
    const FrameRecord& record = process(c, fed->frame);
    if (fed->frame.image.empty())
      keeping_up->note_left_out();
    else
      keeping_up->note_done(fed->due_s, fed->handed_s, feed.now_s());
    if (!c.on_frame({fed->frame, record, c.odometry})) break;
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

Drive drive(ImageSource& source, const OdometryParams& params, const DriveOptions& requested,
            const OnFrame& on_frame) {
  cv::setNumThreads(1);  // the threads are ours: tracking and mapping
  OdometryOptions options = requested.odometry;
  // Frames that come at their own time do not wait: better an older map than a late pose.
  if (source.is_live() || requested.pace.kind != Pace::Kind::kAtOnce) options.max_frames_ahead = 3;
  const Stop stop = requested.stop ? requested.stop : [] { return false; };
  Odometry odometry(source.camera(), params, options);
  LenientSource lenient(source);
  ImageSource& frames = requested.on_bad_frame == OnBadFrame::kSkip ? static_cast<ImageSource&>(lenient) : source;
  Drive result;
  const Course course{lenient, odometry, options, stop, on_frame, &result};
  const auto finish = [&] { result.cpu_s += cpu_seconds([&] { result.run = odometry.finish(); }); };
  if (options.realtime) {
    LiveFeed live_feed(frames, requested.pace);
    KeepingUp keeping_up(source.is_live() ? "that of the camera" : describe(requested.pace));
    result.broken = broken_by(stop, [&] { feed_realtime(course, live_feed, &keeping_up); });
    finish();
    keeping_up.write_to(&result.run);
  } else {
    result.broken = broken_by(stop, [&] { feed(course, frames); });
    finish();
  }
  result.run.T_vehicle_cam = source.T_vehicle_cam();
  return result;
}

}  // namespace edgevo
