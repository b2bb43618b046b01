// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The metric scale during a run: what is known when a frame arrives, by all sources together over the last
// three intervals of the path (scale_course.h).
//
// Feed it with each frame as the odometry delivers it, with each keyframe as it is marginalised and with each
// move of the map. One thread. Memory: the last three intervals of the current segment, and an estimate for
// each frame. Cost: an estimate for each keyframe (camera_height) or for each fifth frame (others), under a
// millisecond.
#include <optional>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/map/map_event.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/scale_params.h"
#include "edgevo/scale/scale_source.h"
#include "edgevo/scale/track_scale.h"

namespace edgevo {

/// The scale estimate of a running odometry.
class LiveScale {
 public:
  /// `sources` may be any; only estimated ones ever yield a scale. `T_vehicle_cam`: mount of the camera, if
  /// known.
  LiveScale(const Pinhole& pinhole, const ScaleSources& sources, VehicleTracks tracks,
            std::optional<SE3> T_vehicle_cam, const ScaleParams& params);

  /// Adds a frame with its live pose. Call in time order. The newest frame may come again in a new segment,
  /// which it begins. Otherwise a frame that comes again is ignored, as is a pose found for it later.
  void add_frame(const FrameRecord& frame);
  /// Adds a marginalised keyframe, in the world of the live poses.
  void add_keyframe(int id, const KeyframeRecord& keyframe);
  /// Follows a move of the current segment's map. The path stays: its poses are live ones. Heights over the
  /// points of a keyframe change with the lengths near it, to the unit of the newest keyframe, in which the
  /// next frames come.
  void apply(const MapMoved& moved);
  /// The unit of the current segment's map was found to be another one from `first_keyframe` on: lengths
  /// there are `ratio` times what they were taken for.
  void rescale(int segment, int first_keyframe, double ratio);

  /// The latest estimate for the current segment; nullopt while there is none.
  const std::optional<ScaleEstimate>& newest() const { return newest_; }
  /// The value of newest() after each frame.
  const std::vector<std::optional<ScaleEstimate>>& history() const { return history_; }

 private:
  void extend_path(const FrameRecord& frame);
  void begin_segment(int segment);
  void forget_what_lies_behind();
  void estimate();
  double interval_units() const;

  const Pinhole pinhole_;
  const ScaleSources sources_;
  const VehicleTracks tracks_;
  const std::optional<SE3> T_vehicle_cam_;
  const ScaleParams params_;

  int segment_ = -1;
  /// Index of the newest frame, and whether it has a pose.
  int newest_frame_ = -1;
  bool has_pose_ = false;
  /// Live poses of the current segment.
  Path path_;
  /// Heights from marginalised keyframes, by travelled distance.
  std::vector<HeightSample> heights_;
  std::optional<ScaleEstimate> newest_;
  std::vector<std::optional<ScaleEstimate>> history_;
  int frames_since_fit_ = 0;
};

/// Position of a track's sensor in the camera's axes, metres; zero if the mount is not known.
Eigen::Vector3d sensor_in_camera(const VehicleTrack& track, const std::optional<SE3>& T_vehicle_cam);

}  // namespace edgevo
