#pragma once
// A source through the odometry, from its first frame to its last or to Ctrl-C: what `edgevo run` and `edgevo bench` have in common.
#include <exception>
#include <functional>

#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/datasets/pace.h"
#include "edgevo/odometry/odometry.h"

namespace edgevo::app {

struct Drive {
  Run run;
  double cpu_s = 0;           ///< of the odometry, all threads: `on_frame` is not in it, and reading images only of a realtime run
  std::exception_ptr broken;  ///< what the source threw, if it did: `run` is the part before
};

/// A frame that has gone through the odometry, with what is known then.
struct DrivenFrame {
  const Frame& frame;
  const FrameRecord& record;
  const Odometry& odometry;
};

/// `on_frame` is called after each frame; false ends the drive. A realtime run gets its frames at `pace`, read ahead, and measures its
/// latency (FrameRecord::latency_ms, Run::realtime). Throws InputError for an unusable camera, detector or pace; what the source throws is
/// returned, so that what was computed before can be written first.
Drive drive(ImageSource& source, const OdometryParams& params, OdometryOptions options,
            const std::function<bool(const DrivenFrame&)>& on_frame, const Pace& pace = {});

/// From here on SIGINT and SIGTERM (job schedulers end a run by it) no longer end the program: they end drives.
void listen_to_signals();
/// Such a signal has come.
bool interrupted();

}  // namespace edgevo::app
