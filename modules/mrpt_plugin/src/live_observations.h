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

  /// Observations of a frame, at its stated time, as those of other sensors: always the image; a pose if
  /// there is one; the points whenever a new keyframe becomes the reference (EDGE_VO_POINTS: axes and origin
  /// of the vehicle, as in playback.rawlog). Throws InputError when an image cannot be written.
  std::vector<mrpt::serialization::CSerializable::Ptr> make(const Grab& grab, const FrameRecord& record,
                                                            const FrameView& view);

 private:
  mrpt::serialization::CSerializable::Ptr image_of(const Grab& grab) const;
  /// The frame as a run of its own, in metres if a scale was given.
  Run run_of(const FrameRecord& record, const FrameView& view) const;

  SensorConfig config_;
  Camera camera_;
  std::optional<SE3> T_vehicle_cam_;
  std::string images_folder_;
  int last_reference_ = -1;
};

}  // namespace edgevo
