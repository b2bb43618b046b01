#pragma once
// The odometry: frames in, poses and edge points out. The way of one image:
//   Frame -> edge pyramid -> alignment -> (keyframe?) -> association -> window BA -> map -> records
// States: BOOTSTRAPPING until two views make a map; TRACKING or DEGRADED while frames align; LOST when one
// does not. A loss keeps everything: the old map is tried for some frames more while a new bootstrap runs,
// and when that succeeds a new segment begins, joined to the old one by constant velocity (position, heading
// and, by equal speed, scale); FrameRecord::segment tells the join.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/image.h"
#include "edgevo/core/live_keyframes.h"
#include "edgevo/core/records.h"
#include "edgevo/edges/edge_detector.h"
#include "edgevo/odometry/frame_view.h"
#include "edgevo/odometry/newest_pose.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

/// How a run is made; what is estimated and how is in OdometryParams.
struct OdometryOptions {
  uint64_t seed = 1;  ///< same seed, same bytes (without `realtime`)
  /// Tracking, mapping and self-calibration in threads of their own: faster, and not bit-identical from run
  /// to run.
  bool realtime = false;
  /// Realtime: so many frames that call for a keyframe may be tracked while the mapping is still busy with
  /// one; then tracking waits for it. 1: nearly the map of a synchronous run. More: fewer waits where frames
  /// come at their own time, on an older map; with 8 a drive at 1 m a frame runs out of it.
  int max_frames_ahead = 1;
  /// Which detectors edges.detector may name.
  EdgeDetectorTable detectors = basic_edge_detectors();
  std::function<void(const std::string&)> log;  ///< one line at each change of state; may be empty
};

/// A run of one camera. One thread.
class Odometry {
 public:
  /// Throws InputError for an unusable camera, or a detector that is unusable or not in the table.
  Odometry(const Camera& camera, const OdometryParams& params, const OdometryOptions& options);
  ~Odometry();

  /// The next frame, in time order. The record holds what is known now; poses found later (bootstrap) and
  /// final poses come with finish(). Throws InputError if the image does not have the camera's size.
  const FrameRecord& process(const Frame& frame);
  /// A frame that came and is not to be processed, since the program is behind its camera: it gets its row,
  /// without a pose and with `why` as its note, and the next frame is expected further on. The image is not
  /// used.
  const FrameRecord& pass_over(const Frame& frame, const std::string& why);

  /// What the newest frame sees of the map. In the thread of process(). Cost: one projection a point, about
  /// 0.1 ms.
  FrameView frame_view() const;
  /// The keyframes that have left the window so far, but for the first `skip` of them. In the thread of
  /// process().
  SettledKeyframes settled_keyframes(size_t skip = 0) const;
  /// The keyframes of the window, if they have changed since `version`. In the thread of process(). Cost: a
  /// copy of their points, about 0.1 ms.
  std::optional<UnsettledKeyframes> unsettled_keyframes(int version = 0) const;
  /// What process() has just found out, with the map that it used. The same thread as process().
  const NewestPose& newest_pose() const;

  /// Ends the run and returns everything: call once, also after an exception from the source.
  Run finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
