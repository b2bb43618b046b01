// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A camera for images without a calibration, from --fov or a photo's EXIF data. No lens distortion, principal
// point in the middle of the image; an initial guess, not a calibration (its cost:
// share/lab/archive/2026-11-24_assumed_camera.md).
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// Type of ImageSource::details().
using Details = std::vector<std::pair<std::string, std::string>>;

/// What a guess can be based on.
struct FirstImage {
  /// File of the image; empty: a frame of a video.
  std::string path;
  /// Size of the image, pixels; 0: to be read from the file.
  int width = 0, height = 0;
};

/// The first that is available of: the user's camera file, --fov, the source's `own` file, EXIF's focal
/// length (35 mm equivalent) in the first image. A guess is reported in `details` under kAssumed. Throws
/// InputError if there is none.
Camera choose_or_assume_camera(const SourceOptions& options, const std::string& own, const FirstImage& image,
                               Details* details);

/// Camera without distortion, with its principal point in the middle, square pixels, and `fov_deg` (0 to 180,
/// exclusive) over the width.
Camera camera_of_field_of_view(double fov_deg, int width, int height);

/// EXIF's 35 mm equivalent focal length in millimetres (36 x 24 mm sensor, by the diagonal); nullopt if the
/// file states none.
std::optional<int> focal_length_35mm(const std::string& image_path);

}  // namespace edgevo
