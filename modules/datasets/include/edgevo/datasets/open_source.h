// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The single entry point for all inputs: whatever SOURCE names on the command line becomes an ImageSource.
//
// Recognised, in this order:
//   camera:N              a live camera, by OpenCV; needs a camera file; ends when the user stops it
//   *.rawlog              an MRPT rawlog (mrpt_bridge/rawlog_source.h)
//   *.bag, *.mcap, *.db3  recordings of ROS 1 and ROS 2, and folders of the latter (recordings/recording.h);
//                         topic: the images, by default the only ones
//   folder with images/   `edgevo` layout: images/, times.txt (seconds, one line an image), camera.txt,
//                         and groundtruth_tum.txt if there is ground truth; DSO's times.txt (`name time`)
//                         and camera.txt, too
//   folder with images.txt  of the DAVIS data set: time and file a line, calib.txt, groundtruth.txt
//   folder with image_N/  and calib.txt: KITTI odometry, sequences/NN; sensor_label image_0 .. image_3,
//                         by default the first that is there
//   folder with rgb.txt   TUM RGB-D; the published calibration where the folder's name holds
//                         freiburg1, freiburg2 or freiburg3
//   folder with mav0/     EuRoC (ASL); sensor_label cam0 (default), cam1
//   Virtual KITTI         a sequence's folder of either release (virtual_kitti.h); 2.0.3: sensor_label
//                         Camera_0 (default), Camera_1
//   folder of images      needs a camera file; times from the names (name_times.h in src) or from fps
//   any other file        a video, by OpenCV; needs a camera file
// A camera file given by the user takes precedence over the source's own calibration. If there is neither,
// --fov or the focal length in a photo's EXIF data gives an initial camera. A file for images of the same
// shape is scaled to these; what was decided, and whether the camera is plausible, is in decisions().
//
// Frames come out as the camera took them (gray, distorted) in time order, numbered from 0 in the whole
// source. Opening reads lists, calibration and the first image, for its size.
#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/camera_mount.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// Options of a source on the command line.
struct SourceOptions {
  /// SOURCE as given.
  std::string path;
  /// Calibration file (camera_file.h); empty: the source's own calibration.
  std::string camera_file;
  /// Size of the images over that which the calibration file is for; 0: from both sizes.
  double camera_scale = 0;
  /// Label of the camera to use, of the source or of a calibration file that has several; empty: the only or
  /// the default one.
  std::string sensor_label;
  /// Topic of a recording of ROS; empty: the only one with images.
  std::string topic;
  /// First frame played; frames first .. last-1 are played (half-open).
  int first = 0;
  /// End of the frames played; nullopt: to the end of the source.
  std::optional<int> last;
  /// Step between frames played, counted from `first`; the frames between are not decoded.
  int every = 1;
  /// Frame rate in frames/s for sources without times; 0: the video's own rate, else 30.
  double fps = 0;
  /// Number of significant bits of images of more than 8 (mrpt_bridge/intensities.h); 0: from the images.
  int bits = 0;
  /// Names of the images to use among those of a folder, with the wildcards * and ?; empty: those of its only
  /// series.
  std::string images;
  /// Unit of the times in a list or in the names of images, "s", "ms", "us" or "ns"; empty: from the times.
  std::string time_unit;
  /// Field of view over the longer side of the images, degrees, for a source without a calibration.
  std::optional<double> fov_deg;
  /// True if only the images are needed: the camera may then be unknown and is made up, which is a decision
  /// "camera: not known".
  bool any_camera = false;
  /// True if images of a folder may have any size, each its own; camera() is for the first.
  bool any_size = false;
  /// Mount of the camera, in place of that of the camera file or the source.
  std::optional<CameraMount> mount;
  /// File of a gyro (gyro_file.h), "off" for none; empty: that of the source, or next to it.
  std::string gyro;
  /// Scale of the images (scaled_source.h); kAutomaticScale: the default for their size.
  double image_scale = 1;
};

/// Name in ImageSource::details() that notifies the user from and to which size images were scaled.
constexpr const char* kScaled = "images scaled";

/// Sets first and last from "A:B", "A:" or ":B" (half-open, A < B). Throws InputError.
void set_frame_range(const std::string& text, SourceOptions* options);

/// Opens the source. Throws InputError: nothing there, an empty folder, an unknown layout, an unreadable list
/// or calibration, different numbers of times and images, an unknown sensor label, a frame range outside the
/// source. next() of the result throws InputError for an image that is missing or does not decode, for a size
/// that differs from the camera's and for times that do not increase; always after the frames before it have
/// been delivered.
std::unique_ptr<ImageSource> open_source(const SourceOptions& options);

/// Opens a source as it is, with its own calibration. Throws InputError.
std::unique_ptr<ImageSource> open_source(const std::string& path);

}  // namespace edgevo
