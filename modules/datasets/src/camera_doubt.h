// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Calibrations that no camera has.
#include <memory>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// Why the camera is implausible for its image size, as sentences; empty if it is not. `is_assumed`: it is by
/// --fov or EXIF, not from a file. Looked at are: a
/// principal point far from the middle (with the size of the images to which the matrix seems to belong), a
/// field of view below 8 or beyond 115 degrees without, 150 with distortion, pixels that are not square by
/// 6 %, tangential terms of more than 0.03, distortion under which parts of the image show nothing. What
/// cannot be seen: a wrong focal length within these bounds, and distortion given for images that are
/// rectified already (self-calibration finds that during a run). Cost: a few hundred projections.
std::string doubt_about(const Camera& camera, bool is_assumed = false);

/// The source, with a doubt about its camera among its decisions if there is one and the camera is not
/// unknown.
std::unique_ptr<ImageSource> with_camera_doubt(std::unique_ptr<ImageSource> source);

}  // namespace edgevo
