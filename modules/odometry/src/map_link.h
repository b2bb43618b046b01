#pragma once
// The tracking side's end of the mapping: hands frames over, and takes keyframes and references back. All
// that the mapping thread touches is in here, and in MapRecords.
#include <memory>
#include <string>

#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/odometry/mapper.h"
#include "edgevo/odometry/odometry.h"
#include "map_records.h"
#include "mapping_thread.h"

namespace edgevo {

/// For the tracking thread; what it is given by `records` must outlive it.
class MapLink {
 public:
  MapLink(const Camera& camera, const OdometryParams& params, const OdometryOptions& options,
          MapRecords* records);

  /// The newest reference; null without a map.
  std::shared_ptr<const Reference> reference() const { return thread_.reference(); }
  /// Hands a frame over (MappingThread::submit).
  void submit(TrackedFrame frame) { thread_.submit(std::move(frame)); }
  /// A keyframe was handed over and is not finished.
  bool is_keyframe_pending() const { return thread_.keyframe_pending(); }
  /// Waits until none is.
  void wait_keyframe() { thread_.wait_keyframe(); }

  /// Builds a map from two views; the one before is closed whatever comes of it. Returns an empty string, or
  /// why they make no map. Waits until all that was handed over is done.
  [[nodiscard]] std::string make_map(const BootstrapResult& views);
  /// The map that was made last is that of `segment`.
  void begin_segment(int segment);

  /// What is known of the camera, for the first frame.
  const CameraRefinement& initial_camera() const { return mapper_.camera(); }

  /// What is left when the run has ended.
  struct Rest {
    CameraRefinement camera;
    /// Frames that mapping has skipped.
    int left_out = 0;
  };
  /// Closes the map. Waits as make_map() does.
  Rest finish();

 private:
  void close_segment();
  void take_update(const TrackedFrame& frame, const MapUpdate& update);
  void take_settled();
  void note_window();

  MapRecords* records_;
  PyramidBuilder rebuilder_;
  Mapper mapper_;
  int segment_ = -1;
  MappingThread thread_;
};

}  // namespace edgevo
