// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A camera for images without a calibration, from --fov or a photo's EXIF data. No lens distortion, principal
// point in the middle of the image; an initial guess, not a calibration (its cost:
// lab 2026-11-24_assumed_camera).
#include <optional>
#include <string>
#include <vector>

#include "camera_fit.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// The first that is available of: the user's camera file, --fov, the source's `own` file, EXIF's focal
/// length (35 mm equivalent) in the first image. What was decided is added to `decisions`; a guess is a
/// doubt. Throws InputError if there is none, unless the options allow any camera.
Camera choose_or_assume_camera(const SourceOptions& options, const std::string& own, const SeenImages& images,
                               std::vector<InputDecision>* decisions);

/// Camera without distortion, with its principal point in the middle, square pixels, and `fov_deg` (0 to 180,
/// exclusive) over the longer side: that is the angle that makers of telephones state, however the telephone
/// is held.
Camera camera_of_field_of_view(double fov_deg, int width, int height);

/// Whether the camera of the source was guessed; and whether it is known, be it by a guess.
bool assumes_camera(const ImageSource& source);
bool knows_camera(const ImageSource& source);

/// EXIF's 35 mm equivalent focal length in millimetres (36 x 24 mm sensor, by the diagonal); nullopt if the
/// file states none.
std::optional<int> focal_length_35mm(const std::string& image_path);

/// The same of the first of the images, pixels, by their diagonal.
std::optional<double> exif_focal_length_px(const SeenImages& images);

}  // namespace edgevo
