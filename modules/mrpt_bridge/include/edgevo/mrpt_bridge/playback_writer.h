#pragma once
// playback.rawlog: a run as MRPT's tools play it (rawlog-edit, RawLogViewer).
//
// Images are written, or linked, while the run goes on; the rawlog itself at the end, with the final poses.
// It is an observations-only rawlog in time order; for each frame
//   CObservationImage        label CAM0 (or as given), image by reference into playback_Images/, as the
//                            camera took it
//   CObservationRobotPose    label EDGE_VO: pose of the vehicle with its covariance (playback_pose.h), where
//                            there is a pose
//   CObservationOdometry     label EDGE_VO_ODO: the same in the plane, for RawLogViewer's "map from odometry"
// and for each keyframe
//   CObservation3DRangeScan  label EDGE_VO_POINTS: its edge points in the axes of the VEHICLE, sensorPose =
//   identity. The pose
//                            beside it is the vehicle's, so pose (+) point is right in point maps and
//                            octomaps alike; the camera's axes are kept for keyframes.simplemap, whose poses
//                            are the camera's.
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
  /// Makes `folder`/playback_Images. Files of an earlier run are overwritten. `camera`: of the images as they
  /// come.
  PlaybackWriter(std::string folder, const Camera& camera, std::string sensor_label = "CAM0");

  /// Writes the image as PNG, lossless. Cost: about 4 ms for 1241x376.
  void add_frame(const Frame& frame);
  /// Instead of add_frame: links to an image that is on disk already. The link is relative where both lie
  /// below one folder other than the root, so that a packed or moved tree of both keeps it; else absolute.
  /// Costs nothing, but breaks when only one of them moves.
  void add_frame_link(int frame_index, const std::string& image_path);
  /// Instead: copies the file, byte by byte. For a folder that stands alone.
  void add_frame_copy(int frame_index, const std::string& image_path);
  /// The images that are in the folder already, of frames up to the `last`: a run that was cut off has left
  /// them.
  void adopt_images(int last);

  /// Where the image of a frame lies; empty if it was not added. Logarithmic.
  std::string image_path(int frame_index) const;

  /// Writes playback.rawlog. Frames whose image was not added get their poses all the same.
  void finish(const Run& run, const PointFilter& filter) const;

 private:
  std::string prepare_image(int frame_index, const std::string& extension);

  std::string folder_;
  Camera camera_;
  std::string sensor_label_;
  std::vector<std::pair<int, std::string>> images_;  ///< frame index and file name, in the order of time
};

}  // namespace edgevo
