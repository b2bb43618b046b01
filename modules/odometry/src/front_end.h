#pragma once
// From an image to a pose: edges, tracking against the reference, and what mapping gets of it. Knows no state
// and no map but the reference.
#include <memory>
#include <optional>

#include "edgevo/core/image.h"
#include "edgevo/core/random.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/odometry/frame_view.h"
#include "edgevo/odometry/mapper.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/odometry/odometry_params.h"
#include "frame_tracker.h"
#include "keyframe_policy.h"
#include "map_coverage.h"
#include "motion_model.h"
#include "rolling_shutter.h"

namespace edgevo {

/// A frame on its way.
struct ArrivedFrame {
  const Frame& frame;
  std::shared_ptr<const FramePyramid> pyramid;
  RowRectification rows;
  FrameRecord* record;
};

/// The tracking thread's.
class FrontEnd {
 public:
  /// Throws InputError for an unusable camera or detector.
  FrontEnd(const Camera& camera, const OdometryParams& params, const OdometryOptions& options);

  /// Each frame first, also one that is not looked at.
  void begin_frame(Timestamp time) { motion_.begin_frame(time); }
  /// The edges of a frame; its rows are rectified for the expected motion if the frame before has a pose.
  /// Without a record. Throws InputError for an image of another size.
  ArrivedFrame find_edges(const Frame& frame, bool has_pose);
  /// The pose of a frame against the reference. Notes times and figures in its record.
  Track find_pose(const ArrivedFrame& now, bool was_lost);
  /// Is the map in view (MapCoverage::look)?
  std::optional<Event> look(const TrackResult& tracked) { return coverage_.look(*reference_, tracked); }
  /// The frame has this pose: what mapping gets of it. Notes a call for a keyframe in its record.
  TrackedFrame hand_over(const ArrivedFrame& now, Track track, bool is_mapping_busy);

  /// What frames are tracked against; null without a map.
  const std::shared_ptr<const Reference>& reference() const { return reference_; }
  /// Mapping has handed out another reference: the last pose is re-expressed against it, and images are
  /// corrected as those of its map.
  void change_reference(std::shared_ptr<const Reference> newest);
  /// The map of a new segment. The frame is its reference; `motion` since the frame before, where known.
  void begin_map(std::shared_ptr<const Reference> reference, const std::optional<SE3>& motion);
  /// There is no map any more.
  void drop_map() { reference_.reset(); }

  /// What is taken out of the images.
  ImageCorrection correction() const { return builder_.correction(); }
  void set_correction(const ImageCorrection& correction) { builder_.set_correction(correction); }
  /// Frames in a row that would have been keyframes had the mapping not been busy.
  int postponed_keyframes() const { return keyframes_.postponed(); }
  /// Of the newest frame; null before the first.
  const std::shared_ptr<const FramePyramid>& newest_pyramid() const { return newest_pyramid_; }
  /// What the newest frame, which has a pose, sees of the map. `idepth_factor`: world over map.
  FrameView view(double idepth_factor) const;

 private:
  ImageMotion expected_motion(bool has_pose) const;
  void rectify_keyframe(const ArrivedFrame& now, const Vector6d& twist, TrackedFrame* tracked);

  OdometryParams params_;
  PyramidBuilder builder_;
  Random random_;  // of corners
  MotionModel motion_;
  KeyframePolicy keyframes_;
  MapCoverage coverage_;
  std::shared_ptr<const Reference> reference_;
  std::shared_ptr<const FramePyramid> newest_pyramid_;
};

}  // namespace edgevo
