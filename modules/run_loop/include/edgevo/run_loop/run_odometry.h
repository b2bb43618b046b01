// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs an image source through the odometry, from its first frame to its last or until the caller stops it:
// the loop that `edgevo run` and `edgevo bench` share.
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/image_source.h"
#include "edgevo/core/records.h"
#include "edgevo/datasets/pace.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/run_loop/past_follower.h"
#include "edgevo/scale/up_direction.h"
#include "edgevo/tracking/frame_view.h"

namespace edgevo {

/// What to do with a frame whose image or time is unusable (core/bad_frame.h).
enum class OnBadFrame {
  /// End the run, as if the source had failed.
  kStop,
  /// Skip the frame: its row gives the reason, and the motion is predicted across the gap. An unusable first
  /// image ends the run all the same.
  kSkip
};

/// Result of run_odometry().
struct RunResult {
  /// The run as Odometry::finish() returns it.
  Run run;
  /// CPU seconds of the odometry in all threads. Excludes `on_frame`; includes reading images only in a
  /// realtime run.
  double cpu_s = 0;
  /// How the gyro sits, where there is one.
  GyroState gyro;
  /// GyroFeed::take_accelerations().
  std::vector<GyroSample> accelerations;
  /// Up by these (scale/up_by_gravity.h); nothing without an accelerometer whose axes are known.
  std::optional<UpEstimate> up_by_gravity() const;
  /// Number of frames skipped because their images or times were unusable.
  int skipped = 0;
  /// What became of the keyframes that were looked up among the places of the run.
  PlaceCounts places;
  /// Reason why the first of the skipped frames was unusable; empty if none was skipped.
  std::string first_skipped;
  /// Exception that the source threw, if any: `run` then holds the frames before it.
  std::exception_ptr broken;
};

/// A frame that the odometry has processed.
struct ProcessedFrame {
  /// The frame; its image is empty if it was skipped.
  const Frame& frame;
  /// Row of the frame as it is now; a pose that is found later (bootstrap) comes with the events and the run.
  const FrameRecord& record;
  /// Makes the view of the map from this frame (Odometry::frame_view()).
  const std::function<FrameView()>& view;
  /// Mask of what is fixed to the camera (Odometry::ego_mask()).
  std::shared_ptr<const Plane<uint8_t>> ego_mask;
};

/// Options of run_odometry().
struct RunLoopOptions {
  /// Seed, threads, log and stream of events of the odometry.
  OdometryOptions odometry;
  /// What is found of the run's past.
  PastParams past;
  /// Rate at which a realtime run receives its frames.
  Pace pace;
  /// What to do with a frame whose image or time is unusable.
  OnBadFrame on_bad_frame = OnBadFrame::kStop;
  /// Polled before each frame and while waiting for one; true ends the run. Empty: never.
  std::function<bool()> stop;
};

/// Runs `source` through the odometry and calls `on_frame` after each frame; false from it ends the run. A
/// realtime run prefetches frames, delivers them at their pace and measures latency (FrameRecord::latency_ms,
/// Run::realtime). Throws InputError for an unusable camera, detector or pace. An exception of the source is
/// returned in RunResult::broken, so that the caller can save the part before it; after `stop` returned true
/// it is dropped, since stopping also interrupts a camera that waits for its next image.
RunResult run_odometry(ImageSource& source, const OdometryParams& params, const RunLoopOptions& options,
                       const std::function<bool(const ProcessedFrame&)>& on_frame);

}  // namespace edgevo
