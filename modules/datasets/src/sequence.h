// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What every folder layout reduces to: a list of image files with times, and a camera. A layout is a function
// from a folder to this value; playback is common to all.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"
#include "text_file.h"

namespace edgevo {

/// Names and values for `edgevo info`.
using Details = std::vector<std::pair<std::string, std::string>>;

struct Sequence {
  std::string kind;
  /// Paths of the images, in order.
  std::vector<std::string> images;
  /// Time of each image; whether times increase is checked frame by frame.
  std::vector<Timestamp> times;
  Camera camera;
  /// Path of the ground truth in TUM format; may be empty.
  std::string ground_truth_path;
  /// Mount of the camera on the vehicle, if the data set states it.
  std::optional<SE3> T_vehicle_cam;
  /// Positions of the vehicle by its GPS; may be empty.
  VehicleTrack gps;
  Details details;
};

std::unique_ptr<ImageSource> play(Sequence sequence);

/// Image files of a folder by name, numbers in names by value ("frame_9" before "frame_10"). Throws
/// InputError if there are none.
std::vector<std::string> list_images(const std::string& folder);

/// Reads times, one decimal number a line: in seconds, or in the finer unit that they appear to be in
/// (time_unit.h), which is then reported in `details` (may be nullptr). Throws InputError.
std::vector<Timestamp> read_times(const std::string& path, Details* details);

/// Parses the times of a list as read_times() does.
std::vector<Timestamp> parse_times_of(const std::vector<TextLine>& times, Details* details);

/// Throws InputError unless there are as many `times` as `images`.
void check_counts(const std::vector<std::string>& images, const std::vector<Timestamp>& times,
                  const std::string& times_path, const std::string& images_folder);

/// The camera file given by the user, else `own` if it exists, else an InputError that requests --camera.
Camera choose_camera(const SourceOptions& options, const std::string& own);

/// `path` if that file exists, else empty.
std::string existing(const std::string& path);

}  // namespace edgevo
