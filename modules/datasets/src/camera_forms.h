// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The forms of calibration files, recognised by their content.
#include <string>

#include "edgevo/core/camera.h"

namespace edgevo {

/// A calibration as its file gives it.
struct CameraText {
  /// Its size is 0 x 0 if the file has none.
  Camera camera;
  /// What was decided in reading it, as a phrase; empty: nothing.
  std::string note;
  /// Why that is doubtful, as a sentence; empty: it is not.
  std::string doubt;

  /// Whether the file states the size of the images.
  bool has_size() const { return camera.width > 0; }
};

/// Parses a calibration of any form that is text, with or without a size; `sensor` names one of several
/// cameras. Throws InputError opened by `where`; for a form of another program that is not read, the message
/// names it.
CameraText parse_camera_text(const std::string& text, const std::string& where,
                             const std::string& sensor = "");

/// Whether a calibration file has several cameras, of which --sensor chooses one. Throws InputError.
bool has_several_cameras(const std::string& path);

/// Parses a calibration without keys: numbers on one line, a 3x3 matrix, ROS's ost.txt.
CameraText parse_camera_numbers(const std::string& text, const std::string& where);

/// What to do with a calibration that is not read, or not supported.
constexpr const char* kWriteNumbers = "write `fx fy cx cy k1 k2 p1 p2 width height` on one line";
constexpr const char* kUndistortImages = "undistort the images beforehand";

/// Camera::check(), of which the size may be missing.
void check_camera_text(const CameraText& text, const std::string& where);

}  // namespace edgevo
