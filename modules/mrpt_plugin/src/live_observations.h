// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One frame of a running odometry as MRPT observations: image, pose, odometry and 3D edge points, all of one
// time.
#include <mrpt/serialization/CSerializable.h>

#include <vector>

#include "edgevo/odometry/odometry.h"
#include "edgevo/tracking/frame_view.h"
#include "grabber.h"
#include "sensor_config.h"

namespace edgevo {

class LiveObservations {
 public:
  LiveObservations(const SensorConfig& config, const Camera& camera, const std::optional<SE3>& T_vehicle_cam);

  /// Existing folder for the images; empty: they are stored inside the rawlog.
  void set_images_folder(const std::string& folder) { images_folder_ = folder; }
  /// From now on the world's lengths are metres: of a map that the recording was found in.
  void set_metres() { is_in_metres_ = true; }

  /// Observations of a frame, at its stated time, as those of other sensors: always the image; poses if there
  /// are any, in `odom` and by map -> odom in `map`; map -> odom itself at first and after each change
  /// (EDGE_VO_MAP_ODOM, with a comment that has their number); the points whenever a new keyframe becomes the
  /// reference (EDGE_VO_POINTS: axes and origin of the vehicle, as in playback.rawlog). Throws InputError
  /// when an image cannot be written.
  std::vector<mrpt::serialization::CSerializable::Ptr> make(const Grab& grab, const FrameRecord& record,
                                                            const NewestPose& newest, const FrameView& view);

 private:
  mrpt::serialization::CSerializable::Ptr image_of(const Grab& grab) const;
  /// The frame as a run of its own, in metres if a scale was given; T_world_cam: in `map`.
  Run run_of(const FrameRecord& record, const SE3& T_world_odom, const FrameView& view) const;
  /// map -> odom, and what holds for all lengths.
  std::vector<mrpt::serialization::CSerializable::Ptr> frames_of(const Run& run,
                                                                 const NewestPose& newest) const;

  SensorConfig config_;
  Camera camera_;
  std::optional<SE3> T_vehicle_cam_;
  std::string images_folder_;
  bool is_in_metres_ = false;
  int last_reference_ = -1, last_changes_ = -1;
};

}  // namespace edgevo
