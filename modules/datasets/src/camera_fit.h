// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From a calibration file to the camera of the available images, which may be smaller than those it was made
// with, or turned.
#include <string>
#include <vector>

#include "camera_change.h"
#include "camera_forms.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/input_decision.h"

namespace edgevo {

/// What is known of the images of a source before they are read.
struct SeenImages {
  /// Files by which to find their size: the first, one in the middle, the last; empty: a video.
  std::vector<std::string> paths;
  /// Size of the images, pixels; 0: to be read from the files, or not known.
  int width = 0, height = 0;
  /// Clockwise quarter turns, 0 to 3, by which a video's frames have been turned on decoding.
  int quarter_turns = 0;
};

/// The images in a list of files.
SeenImages seen_images(const std::vector<std::string>& paths);

/// Reads the size of the images unless it is known: that of the first if it is `width` x `height`, else the
/// one that most of `paths` have. Stays 0 if none of them decodes.
void find_size(int width, int height, SeenImages* images);

/// Reads a calibration file of any form; `sensor` names one of several cameras. Throws InputError.
CameraText read_camera_text(const std::string& path, const std::string& sensor = "");

/// A calibration file and what the user says about it.
struct CameraFile {
  std::string path;
  /// Name of one of its cameras, if it has several.
  std::string sensor;
  /// Size of the images over that of the calibration; 0: not given.
  double scale = 0;
};

/// The camera of a calibration file for these images. A missing size is theirs; a calibration for images of
/// the same shape is scaled, one for images as they were before they were turned is turned; `decisions` says
/// so. Throws InputError that names both sizes where the shapes differ.
Camera camera_of_file(const CameraFile& file, SeenImages images, std::vector<InputDecision>* decisions);

}  // namespace edgevo
