#pragma once
// A source through the odometry, from its first frame to its last or until it is told to stop: what `edgevo
// run` and `edgevo bench` have in common.
#include <exception>
#include <functional>

#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/datasets/pace.h"
#include "edgevo/odometry/odometry.h"

namespace edgevo {

struct Drive {
  Run run;
  double cpu_s = 0;  ///< of the odometry, all threads: `on_frame` is not in it, and reading images only of a
                     ///< realtime run
  std::exception_ptr broken;  ///< what the source threw, if it did: `run` is the part before
};

/// A frame that has gone through the odometry, with what is known then.
struct DrivenFrame {
  const Frame& frame;
  const FrameRecord& record;
  const Odometry& odometry;
};

struct DriveOptions {
  OdometryOptions odometry;
  Pace pace;  ///< at which a realtime run gets its frames
  std::function<bool()>
      stop;  ///< asked before each frame and while one is waited for: true ends the drive; none: never
};

/// `on_frame` is called after each frame; false ends the drive. A realtime run gets its frames at their pace,
/// read ahead, and measures its latency (FrameRecord::latency_ms, Run::realtime). Throws InputError for an
/// unusable camera, detector or pace; what the source throws is returned, so that what was computed before
/// can be written first; but nothing that it throws once it was told to stop: that ends a camera's wait for
/// its next image, too.
Drive drive(ImageSource& source, const OdometryParams& params, const DriveOptions& options,
            const std::function<bool(const DrivenFrame&)>& on_frame);

}  // namespace edgevo
