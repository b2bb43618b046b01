#pragma once
// A camera for images that came without a calibration: --fov, or what a photo says of its lens. No lens
// distortion, the centre in the middle of the image; a start, not a calibration
// (share/lab/archive/2026-11-24_assumed_camera.md says what it costs).
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// As ImageSource::details().
using Details = std::vector<std::pair<std::string, std::string>>;

/// What is there to guess by.
struct FirstImage {
  std::string path;           ///< its file; empty: a frame of a video
  int width = 0, height = 0;  ///< 0: to be read from the file
};

/// The first that there is: the user's camera file, --fov, the source's `own` file, EXIF's focal length (35
/// mm equivalent) in the first image. A guess is told in `details` under kAssumed. Throws InputError: none of
/// them.
Camera choose_or_assume_camera(const SourceOptions& options, const std::string& own, const FirstImage& image,
                               Details* details);

/// No lens, centre in the middle, square pixels, `fov_deg` (0 to 180, exclusive) over the width.
Camera camera_of_field_of_view(double fov_deg, int width, int height);

/// EXIF's focal length in millimetres as if the sensor were that of a 35 mm film (36 x 24 mm, by the
/// diagonal); nullopt if the file does not say.
std::optional<int> focal_length_35mm(const std::string& image_path);

}  // namespace edgevo
