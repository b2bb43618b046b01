// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// playback.rawlog: a run as MRPT's tools play it (rawlog-edit, RawLogViewer).
//
// Images are written, or linked, during the run; the rawlog itself at the end, with the final poses. It is an
// observations-only rawlog in time order. First a CObservationComment: whether lengths are metres. For each
// frame
//   CObservationImage        label CAM0 (or as given), image by reference into playback_Images/, as the
//                            camera took it
//   CObservationRobotPose    label EDGE_VO_LIVE: pose of the vehicle in `odom`, as it was known then
//   CObservationRobotPose    label EDGE_VO: final pose of the vehicle in `map` with its covariance
//                            (playback_pose.h), where there is a pose
//   CObservationOdometry     label EDGE_VO_ODO: the same in the plane, for RawLogViewer's "map from odometry"
// and for each keyframe
//   CObservation3DRangeScan  label EDGE_VO_POINTS: its edge points in the axes of the VEHICLE, sensorPose =
//                            identity. The preceding pose is that of the vehicle, so that pose (+) point is
//                            right in point maps and octomaps alike; keyframes.simplemap has the camera's
//                            axes instead, since its poses are those of the camera.
// Lengths are in the unit of the run. The tools find the images only when started in the folder of the rawlog
// (MRPT 2.5.8).
//
// A keyframe's points stay in memory until the end, as the run's records do; images do not. Not thread-safe.
// All functions throw InputError when something cannot be written.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Writes the playback of one run.
class PlaybackWriter {
 public:
  /// Creates `folder`/playback_Images. Files of an earlier run are overwritten. `camera`: camera of the
  /// unscaled images.
  PlaybackWriter(std::string folder, const Camera& camera, std::string sensor_label = "CAM0");

  /// Writes the image as PNG, lossless. Cost: about 4 ms for 1241x376.
  void add_frame(const Frame& frame);
  /// Instead of add_frame(), links to an image that is already on disk. The link is relative if both are
  /// below one folder other than the root, so that it survives moving both together; else absolute. It breaks
  /// if only one of them moves.
  void add_frame_link(int frame_index, const std::string& image_path);
  /// Instead of add_frame(), copies the image file byte by byte, for a self-contained folder.
  void add_frame_copy(int frame_index, const std::string& image_path);
  /// Forgets the names of the images so far: adopt_images() finds them again.
  void forget_images() { images_.clear(); }
  /// Adopts the images already in the folder for frames up to `last`, as left by an interrupted run.
  void adopt_images(int last);

  /// Path of a frame's image; empty if it was not added. Cost: logarithmic.
  std::string image_path(int frame_index) const;

  /// Writes playback.rawlog. Frames without an image still get their poses.
  void finish(const Run& run, const PointFilter& filter) const;

 private:
  std::string prepare_image(int frame_index, const std::string& extension);

  std::string folder_;
  Camera camera_;
  std::string sensor_label_;
  /// Frame index and file name, in time order.
  std::vector<std::pair<int, std::string>> images_;
};

}  // namespace edgevo
