// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The odometry: frames in, poses and edge points out. The path of one image:
//   Frame -> edge pyramid -> alignment -> (keyframe?) -> association -> window BA -> map -> records
// States: BOOTSTRAPPING until two views make a map; TRACKING or DEGRADED while frames align; LOST when one
// does not. A loss discards nothing: relocalisation in the old map is tried for some frames while a new
// bootstrap runs. When the bootstrap succeeds, a new segment begins, joined to the old one by
// features that both show, else by constant velocity, a guess; FrameRecord::segment marks the join.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/records.h"
#include "edgevo/edges/edge_detector_table.h"
#include "edgevo/odometry/newest_pose.h"
#include "edgevo/odometry/odometry_params.h"

namespace edgevo {

struct GyroModel;     // gyro/gyro_model.h
struct GyroSample;    // core/gyro_sample.h
class Map;            // map/map.h
class MapLog;         // map/map_log.h
class Rectification;  // core/rectification.h
enum class Shedding;  // mapping/shedding.h
struct FramePyramid;  // edges/frame_pyramid.h
struct FrameView;     // tracking/frame_view.h
struct LocatedPose;   // map/located_pose.h
struct MapMoved;      // map/map_event.h
template <class T>
class Plane;  // edges/plane.h

/// What is known of the gyro.
struct GyroState {
  /// One line in words; empty without samples.
  std::string statement;
  /// Rotation, offset, bias; null before they are found.
  std::shared_ptr<const GyroModel> model;
};

/// How a run works; what it estimates is in OdometryParams.
struct OdometryOptions {
  /// Seed of all random numbers: the same seed gives the same bytes (without `realtime`).
  uint64_t seed = 1;
  /// Pinhole camera to work in, of any size and focal length; Run::pinhole. Raw images are rectified to it,
  /// and pixels without a source get no edges. Nullopt: target_pinhole() (core/target_pinhole.h).
  std::optional<Pinhole> working_pinhole;
  /// Run tracking, mapping and self-calibration in threads of their own: faster, but not bit-identical from
  /// run to run.
  bool realtime = false;
  /// Realtime: frames that call for a keyframe and may be tracked while mapping is still busy with one;
  /// beyond, tracking waits. 1: nearly the map of a synchronous run. Larger: fewer waits for live cameras, on
  /// an older map; at 8, a camera that moves 1 m per frame outruns its map.
  int max_frames_ahead = 1;
  /// Realtime: frames arrive on a schedule of their own (a camera, a pace), and each is answered at once. The
  /// bootstrap then runs next to the frames, which get their poses afterwards, and a frame waits for mapping
  /// 50 ms at most.
  bool on_schedule = false;
  /// What the events report leaves the memory, which then does not grow with the run: finish() returns the
  /// newest frames only, with their live poses, and no keyframes, and producers of moves see only keyframes
  /// that still have matches. For a run whose events are kept elsewhere (results/recovery_log.h).
  bool forget = false;
  /// What an earlier run has found of the gyro; null: nothing.
  std::shared_ptr<const GyroModel> gyro;
  /// Camera of whose rolling shutter an earlier look at the same frames knows; nothing: a global one, until
  /// the run shows another.
  std::optional<CameraPosterior> camera;
  /// Detectors that the parameter edges.detector may name.
  EdgeDetectorTable detectors = basic_edge_detectors();
  /// The stream that consumers read (map/map_log.h), of this odometry alone: another one needs its own. Null:
  /// nobody follows the map.
  std::shared_ptr<MapLog> map_log;
  /// A producer of moves besides self-calibration, e.g. a recognition of places; may be empty. Called once
  /// per keyframe, in the thread of mapping, after self-calibration; nothing returned leaves the map as it
  /// is. Map::move() says which moves are refused, by an exception; so is one that changes the lens.
  std::function<std::optional<MapMoved>(const Map&)> move_map;
  /// Locates an image in a map that was kept (places/view_locator.h); may be empty. Called in the thread of
  /// process() for each frame until the run has made a map of its own: what is found is the frame's pose, in
  /// a segment whose map is the kept one. Then, but not with `on_schedule`, for the frames of the first
  /// keyframes of that map, of whose places it is a measurement.
  std::function<std::optional<LocatedPose>(const FramePyramid&)> locate;
  /// Called with one line at each change of state; may be empty.
  std::function<void(const std::string&)> log;
};

/// From the camera that takes the images to the pinhole in which a run with these options works.
Rectification rectification_of(const Camera& camera, const OdometryOptions& options);

/// A run of one camera, in one thread. Keyframes, and poses that are found later, come as events
/// (OdometryOptions::map_log).
class Odometry {
 public:
  /// Throws InputError for an unusable camera or working pinhole, or a detector that is unusable or not in
  /// the table.
  explicit Odometry(const Camera& camera, const OdometryParams& params = {},
                    const OdometryOptions& options = {});
  ~Odometry();

  /// Takes a sample of a gyro that is fixed to the camera, in any axes; how it sits is found. They come in
  /// the order of their times, those up to a frame and the tenth of a second after it before that frame, as
  /// far as they are there; samples that come later help the next one. Call in the thread of process(). Cost:
  /// 0.3 microseconds.
  void add_gyro(const GyroSample& sample);
  /// How the gyro sits, by now: in words, and as numbers once it is known. Call in the thread of process().
  GyroState gyro() const;

  /// Processes the next frame. The record holds what is known now; poses found later (bootstrap) and final
  /// poses come with finish(). Throws InputError, and nothing has happened, unless index and time are after
  /// those of the frame before and the image has the camera's size and that many pixels; std::logic_error
  /// after close().
  FrameRecord process(const Frame& frame);
  /// Records a frame that is not processed, e.g. because the program is behind its camera: it gets a record
  /// without a pose, with `why` as its note, and the motion model counts it. The image is not used. A frame
  /// whose own time is wrong is given that of the frame before; its record is a tick later than that one's.
  /// Throws InputError for a time before that, or an index that is not after it; std::logic_error after
  /// close().
  FrameRecord skip(const Frame& frame, const std::string& why);

  /// What is skipped from the next frame on, in realtime: for a caller whose frames come too late.
  void shed(Shedding shedding);

  /// View of the map from the newest frame. Call in the thread of process(). Cost: one projection per point,
  /// about 0.1 ms.
  FrameView frame_view() const;
  /// Mask of what is fixed to the camera in the newest raw image, 255 on it; null if there is nothing. Call
  /// in the thread of process(). Cost: none.
  std::shared_ptr<const Plane<uint8_t>> ego_mask() const;
  /// The result of the last process() call, with the map that it used. Call in the thread of process().
  const NewestPose& newest_pose() const;

  /// Takes no more frames: mapping ends, and the last keyframes leave the window. Whoever looks for relations
  /// between keyframes may add them to the log until finish(), which closes what is not closed. Throws
  /// std::logic_error if called again.
  void close();
  /// Ends the run and returns everything, also after an exception from the source. Throws std::logic_error if
  /// called again.
  Run finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
