// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tracking side's end of mapping: submits frames, and receives keyframes and references. All that the
// mapping thread touches is in here and in MapRecords.
#include <memory>
#include <string>

#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/odometry/mapper.h"
#include "edgevo/odometry/odometry.h"
#include "map_records.h"
#include "mapping_thread.h"

namespace edgevo {

/// Connects tracking to mapping; for the tracking thread.
class MapLink {
 public:
  /// `records` must outlive this object.
  MapLink(const Camera& camera, const OdometryParams& params, const OdometryOptions& options,
          MapRecords* records);

  /// The newest reference; null without a map.
  std::shared_ptr<const Reference> reference() const { return thread_.reference(); }
  /// Passes a frame to mapping (MappingThread::submit).
  void submit(TrackedFrame frame) { thread_.submit(std::move(frame)); }
  /// True while a submitted keyframe is not finished.
  bool is_keyframe_pending() const { return thread_.keyframe_pending(); }
  /// Waits until no keyframe is pending.
  void wait_keyframe() { thread_.wait_keyframe(); }

  /// Closes the present map, if any, and builds a new one from two views. Returns an empty string, or why
  /// they make no map. Waits until all submitted frames are processed.
  [[nodiscard]] std::string make_map(const BootstrapResult& views);
  /// Makes the newest map that of `segment`.
  void begin_segment(int segment);

  /// Camera knowledge before the first frame.
  const CameraRefinement& initial_camera() const { return mapper_.camera(); }

  /// Results of mapping at the end of a run.
  struct Rest {
    /// Self-calibration.
    CameraRefinement camera;
    /// Frames that mapping has skipped.
    int skipped = 0;
  };
  /// Closes the map. Waits as make_map() does.
  Rest finish();

 private:
  void close_segment();
  void take_update(const TrackedFrame& frame, const MapUpdate& update);
  void record_marginalised();
  void note_window();

  MapRecords* records_;
  PyramidBuilder rebuilder_;
  Mapper mapper_;
  int segment_ = -1;
  MappingThread thread_;
};

}  // namespace edgevo
