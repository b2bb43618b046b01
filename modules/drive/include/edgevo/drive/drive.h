#pragma once
// A source through the odometry, from its first frame to its last or until it is told to stop: what `edgevo
// run` and `edgevo bench` have in common.
#include <exception>
#include <functional>
#include <string>

#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/datasets/pace.h"
#include "edgevo/odometry/odometry.h"

namespace edgevo {

/// What a frame whose image cannot be used (core/bad_frame.h) does to a drive.
enum class OnBadFrame {
  kStop,  ///< ends it, as a source that broke
  kSkip   ///< it is left out: its row says why, and the motion is foreseen over the gap. Not the first frame
};

/// What a drive has led to.
struct Drive {
  Run run;  ///< as Odometry::finish() returns it
  double cpu_s = 0;  ///< of the odometry, all threads: `on_frame` is not in it, and reading images only of a
                     ///< realtime run
  int left_out = 0;  ///< frames whose images could not be used
  std::string first_left_out;  ///< what was wrong with the first of them
  std::exception_ptr broken;   ///< what the source threw, if it did: `run` is the part before
};

/// A frame that has gone through the odometry, with what is known then.
struct DrivenFrame {
  const Frame& frame;  ///< without image where it was left out
  const FrameRecord&
      record;  ///< stays where it is until the drive ends, and may get its pose later (a bootstrap)
  const Odometry& odometry;  ///< after this frame
};

/// How a source is driven through the odometry.
struct DriveOptions {
  OdometryOptions odometry;  ///< seed, threads, log
  Pace pace;  ///< at which a realtime run gets its frames
  OnBadFrame on_bad_frame = OnBadFrame::kStop;  ///< see above
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
