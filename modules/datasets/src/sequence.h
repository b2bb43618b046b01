// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What every folder layout reduces to: a list of image files with times, and a camera. A layout is a function
// from a folder to this value; playback is common to all.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "camera_fit.h"
#include "edgevo/core/image_source.h"
#include "edgevo/core/input_decision.h"
#include "edgevo/datasets/open_source.h"
#include "text_file.h"

namespace edgevo {

/// Names and values for `edgevo info`.
using Details = std::vector<std::pair<std::string, std::string>>;
using Decisions = std::vector<InputDecision>;

struct Sequence {
  std::string kind;
  /// Paths of the images, in order.
  std::vector<std::string> images;
  /// Time of each image, kNoTime where it has none; they are checked frame by frame (core/time_order.h).
  std::vector<Timestamp> times;
  Camera camera;
  /// Path of the ground truth in TUM format; may be empty.
  std::string ground_truth_path;
  /// Mount of the camera on the vehicle, if the data set states it.
  std::optional<SE3> T_vehicle_cam;
  /// Positions of the vehicle by its GPS; may be empty.
  VehicleTrack gps;
  Details details;
  /// Whether images may differ in size from the camera.
  bool any_size = false;
  /// Whether the order is that of the names, not of a list, which might contradict them.
  bool ordered_by_names = false;
  /// What the layout decided; how deep images are read is decided by play().
  Decisions decisions;
};

/// Plays a sequence. `bits`: significant bits of images of more than 8, or 0 (mrpt_bridge/intensities.h).
/// Throws InputError for bits that do not fit the images.
std::unique_ptr<ImageSource> play(Sequence sequence, int bits);

/// Reads times, one decimal number a line: in the unit that the user gave, else in seconds or the finer unit
/// that they appear to be in (time_unit.h), which is then added to `decisions` (may be nullptr). "nan" and
/// "-" become kNoTime. Throws InputError.
std::vector<Timestamp> read_times(const std::string& path, const SourceOptions& options,
                                  Decisions* decisions);

/// Parses the times of a list as read_times() does.
std::vector<Timestamp> parse_times_of(const std::vector<TextLine>& times, const SourceOptions& options,
                                      Decisions* decisions);

/// Throws InputError unless there are as many `times` as `images`.
void check_counts(const std::vector<std::string>& images, const std::vector<Timestamp>& times,
                  const std::string& times_path, const std::string& images_folder);

/// The camera file given by the user, else `own` if it exists, else an InputError that requests --camera.
CameraFile camera_file_of(const SourceOptions& options, const std::string& own);

/// `path` if that file exists, else empty.
std::string existing(const std::string& path);

}  // namespace edgevo
