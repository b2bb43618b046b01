#pragma once
// What every folder layout amounts to: a list of image files with times, and a camera. A layout is a function
// from a folder to this value; playing it is the same for all.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"
#include "text_file.h"

namespace edgevo {

using Details = std::vector<std::pair<std::string, std::string>>;  ///< name and value, for `edgevo info`

struct Sequence {
  std::string kind;
  std::vector<std::string> images;  ///< paths, in order
  std::vector<Timestamp> times;     ///< one for each; whether they increase is checked frame by frame
  Camera camera;
  std::string ground_truth_path;     ///< TUM format; may be empty
  std::optional<SE3> T_vehicle_cam;  ///< where the camera sits, if the data set says so
  VehicleTrack gps;                  ///< where the vehicle's GPS says that it was; may be empty
  Details details;
};

std::unique_ptr<ImageSource> play(Sequence sequence);

/// Image files of a folder by name, numbers in names by value ("frame_9" before "frame_10"). Throws
/// InputError if there are none.
std::vector<std::string> list_images(const std::string& folder);

/// Times, one decimal number a line: seconds, or the finer unit that they seem to be in (time_unit.h), which
/// `details` then tells (nullptr: nobody asks). Throws InputError.
std::vector<Timestamp> read_times(const std::string& path, Details* details);

/// The same from the texts of a list's times.
std::vector<Timestamp> parse_times_of(const std::vector<TextLine>& times, Details* details);

/// Throws InputError unless `times` and `images` are as many.
void check_counts(const std::vector<std::string>& images, const std::vector<Timestamp>& times,
                  const std::string& times_path, const std::string& images_folder);

/// The camera file the user gave, else `own` if that exists, else InputError asking for --camera.
Camera choose_camera(const SourceOptions& options, const std::string& own);

/// `path` if such a file exists, else empty.
std::string existing(const std::string& path);

}  // namespace edgevo
