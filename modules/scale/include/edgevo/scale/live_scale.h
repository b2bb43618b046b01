#pragma once
// The metric scale while a run is going on: what is known when a frame comes, from the stretch behind it alone.
//
// Feed it with each frame as the odometry hands it out and with each keyframe as it leaves the window. One thread.
// Memory: the last three stretches of the present segment, and an estimate for each frame. Cost: a fit for each keyframe
// (camera_height) or for each fifth frame (others), under a millisecond.
#include <optional>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/scale_params.h"
#include "edgevo/scale/scale_source.h"
#include "edgevo/scale/track_scale.h"

namespace edgevo {

/// The scale as it becomes known.
class LiveScale {
 public:
  /// `source` may be any; only estimated ones ever know a scale. `T_vehicle_cam`: the camera's mount, if it is known.
  LiveScale(const Pinhole& pinhole, const ScaleSource& source, VehicleTrack track, std::optional<SE3> T_vehicle_cam,
            const ScaleParams& params);

  /// A frame with its live pose, in the order of time.
  void add_frame(const FrameRecord& frame);
  /// A keyframe that has left the window, in the world of the live poses.
  void add_keyframe(const KeyframeRecord& keyframe);

  /// The newest estimate of the present segment; nullopt while there is none.
  const std::optional<ScaleEstimate>& newest() const { return newest_; }
  /// What newest() was after each frame.
  const std::vector<std::optional<ScaleEstimate>>& history() const { return history_; }

 private:
  void begin_segment(int segment);
  void forget_what_lies_behind();
  void estimate_from_track();
  void estimate_from_ground();
  double stretch_units() const;

  const Pinhole pinhole_;
  const ScaleSource source_;
  const VehicleTrack track_;
  const std::optional<SE3> T_vehicle_cam_;
  const ScaleParams params_;

  int segment_ = -1;
  Path path_;                          ///< live, of the present segment
  std::vector<HeightSample> heights_;  ///< of keyframes that have settled
  std::optional<ScaleEstimate> newest_;
  std::vector<std::optional<ScaleEstimate>> history_;
  int frames_since_fit_ = 0;
};

/// Where the sensor of a track sits in the camera's axes, metres; zero where the mount is not known.
Eigen::Vector3d sensor_in_camera(const VehicleTrack& track, const std::optional<SE3>& T_vehicle_cam);

}  // namespace edgevo
