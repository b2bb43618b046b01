#pragma once
// One way in for every kind of input: whatever SOURCE names on the command line becomes an ImageSource.
//
// Recognised, in this order:
//   camera:N              a live camera, by OpenCV; needs a camera file; ends when the user stops it
//   *.rawlog              an MRPT rawlog (mrpt_bridge/rawlog_source.h)
//   folder with images/   `edgevo` layout: images/, times.txt (seconds, one line an image), camera.txt,
//                         and groundtruth_tum.txt if there is ground truth
//   folder with image_N/  and calib.txt: KITTI odometry, sequences/NN; sensor_label image_0 .. image_3,
//                         by default the first that is there
//   folder with rgb.txt   TUM RGB-D; the published calibration where the folder's name holds
//                         freiburg1, freiburg2 or freiburg3
//   folder with mav0/     EuRoC (ASL); sensor_label cam0 (default), cam1
//   Virtual KITTI         a sequence's folder of either release (virtual_kitti.h); 2.0.3: sensor_label Camera_0 (default), Camera_1
//   Symphony Lake         a survey's folder (with image_auxilliary.csv), ARCHIVE/SURVEY, or an archive with one survey (source_place.h)
//   folder of images      needs a camera file; times from the names (ns or seconds) or from fps
//   any other file        a video, by OpenCV; needs a camera file
// A camera file given by the user wins over the source's own calibration. Where there is neither, --fov or the focal
// length in a photo's EXIF data makes a camera to start with.
//
// Frames come out as the camera took them (gray, distorted) in time order, numbered from 0 in the whole
// source. Opening reads lists and calibration, not the images (but the first one, where the calibration does
// not state the size).
#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/image_source.h"

namespace edgevo {

struct SourceOptions {
  std::string path;          ///< SOURCE
  std::string camera_file;   ///< camera_file.h; empty: the source's own calibration
  std::string sensor_label;  ///< which of several cameras; empty: the only or the usual one
  int first = 0;             ///< frames first .. last-1 of the source (half-open)
  std::optional<int> last;   ///< nullopt: to the end
  int every = 1;   ///< and of these each every-th, beginning with `first`; the others are not decoded
  double fps = 0;  ///< frames a second, for sources without times; 0: the video's own rate, else 30
  std::optional<double> fov_deg;  ///< over the image's width, for a source without a calibration
  bool any_camera = false;  ///< the images alone are wanted: the camera need not be known, and may be made up
  double image_scale = 1;   ///< of the images (scaled_source.h); 0: the usual one for their width
};

/// Names in ImageSource::details() for what a user must be told: how the camera was guessed, and that images were scaled.
constexpr const char* kAssumed = "camera assumed";
constexpr const char* kScaled = "images scaled";

/// Sets first and last from "A:B", "A:" or ":B" (half-open, A < B). Throws InputError.
void set_frame_range(const std::string& text, SourceOptions* options);

/// Throws InputError: nothing there, an empty folder, a layout that is not recognised, a list or calibration
/// that is not readable, not as many times as images, an unknown sensor label, a stretch of frames outside
/// the source. next() of the result throws InputError for an image that is missing or does not decode, a size
/// that is not the camera's and times that do not increase; always after the frames before have been handed
/// out.
std::unique_ptr<ImageSource> open_source(const SourceOptions& options);

}  // namespace edgevo
