// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tracking side's end of mapping: submits frames, and receives references. All that the mapping thread
// touches is in here; what crosses between the threads is in the types: a TrackedFrame goes in, an immutable
// Reference and the events of the map (MapLog) come out.
#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/mapping/mapper.h"
#include "edgevo/mapping/mapping_thread.h"

namespace edgevo {

/// How the two work together in a run.
struct MapLinkOptions {
  /// Seed of the run.
  uint64_t seed = 1;
  /// Mapping runs in threads of its own.
  bool realtime = false;
  /// Frames come on a schedule of their own: none waits long for mapping.
  bool on_schedule = false;
  /// Detectors that EdgeParams::detector may name.
  EdgeDetectorTable detectors = basic_edge_detectors();
  /// MapperOptions::move_map.
  MoveMap move_map;
  /// MapperOptions::forget.
  bool forget = false;
  /// MapperOptions::camera.
  std::optional<CameraPosterior> camera = std::nullopt;
};

/// Connects tracking to mapping; for the tracking thread.
class MapLink {
 public:
  /// `log`, not null, receives the events of the map.
  MapLink(const Rectification& rectification, const EdgeParams& edges, const MapperParams& params,
          const MapLinkOptions& options, std::shared_ptr<MapLog> log);

  /// The newest reference; null without a map.
  std::shared_ptr<const Reference> reference() const { return thread_.reference(); }
  /// Passes a frame to mapping (MappingThread::submit), unless it is shed.
  void submit(TrackedFrame frame);
  /// True while a submitted keyframe is not finished.
  bool is_keyframe_pending() const { return thread_.keyframe_pending(); }
  /// Waits until no keyframe is pending; 50 ms at most where frames come on a schedule, 20 where work is
  /// shed.
  void wait_keyframe() {
    constexpr std::chrono::milliseconds kShort{20};
    thread_.wait_keyframe(shedding_ == Shedding::kNothing ? longest_wait_ : kShort);
  }
  /// What mapping skips from now on.
  void shed(Shedding shedding);

  /// Rebuilds the images of the views for their motions, where a rolling shutter has read them: 8 ms each.
  void rectify_rows(BootstrapResult* views);
  /// Closes the present map, if any, and builds a new one from two views. Returns nothing, or why
  /// they make no map. Waits until all submitted frames are processed.
  [[nodiscard]] Reasons make_map(const BootstrapResult& views);
  /// Makes the newest map that of `segment`, whose pose has been announced.
  void begin_segment(int segment);

  /// The reference of a map that was made, before its segment begins.
  std::shared_ptr<const Reference> first_reference() const { return mapper_.reference(); }

  /// Sets the correction of a builder of images. Tables for it that mapping has made already are shared: 10
  /// ms in which a frame would wait.
  void correct(PyramidBuilder* builder, const ImageCorrection& correction);

  /// Camera knowledge before the first frame.
  const CameraPosterior& initial_camera() const { return mapper_.camera(); }

  /// Closes the map. Waits as make_map() does. Returns what mapping has skipped; the other fields are not
  /// set.
  RealtimeRecord finish();

 private:
  std::shared_ptr<const FramePyramid> rebuild(const FramePyramid& old, const ImageMotion& motion,
                                              const ImageCorrection& now);
  void close_segment();

  std::chrono::milliseconds longest_wait_;
  std::shared_ptr<MapLog> log_;
  std::mutex rebuilding_;  // guards rebuilder_: corrections are prepared next to mapping
  PyramidBuilder rebuilder_;
  Mapper mapper_;
  MappingThread thread_;
  Shedding shedding_ = Shedding::kNothing;
  int depths_shed_ = 0;  // frames
};

}  // namespace edgevo
