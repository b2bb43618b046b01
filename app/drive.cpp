#include "drive.h"

#include <csignal>
#include <ctime>
#include <opencv2/core.hpp>

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

void feed(ImageSource& source, Odometry& odometry, const std::function<bool(const DrivenFrame&)>& on_frame, Drive* drive) {
  try {
    while (!interrupted()) {
      const std::optional<Frame> frame = source.next();
      if (!frame) break;
      const FrameRecord* record = nullptr;
      drive->cpu_s += cpu_seconds([&] { record = &odometry.process(*frame); });
      if (!on_frame({*frame, *record, odometry})) break;
    }
  } catch (const std::exception&) {
    drive->broken = std::current_exception();
  }
}

}  // namespace

void listen_to_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() { return signalled != 0; }

Drive drive(ImageSource& source, const OdometryParams& params, const OdometryOptions& options,
            const std::function<bool(const DrivenFrame&)>& on_frame) {
  cv::setNumThreads(1);  // the threads are ours: tracking and mapping
  Odometry odometry(source.camera(), params, options);
  Drive result;
  feed(source, odometry, on_frame, &result);
  result.cpu_s += cpu_seconds([&] { result.run = odometry.finish(); });
  result.run.T_vehicle_cam = source.T_vehicle_cam();
  return result;
}

}  // namespace edgevo::app
