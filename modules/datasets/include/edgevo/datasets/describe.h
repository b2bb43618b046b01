#pragma once
// What `edgevo info` tells about a source: name and value, in the order of reading.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Kind, frames, image size, camera, field of view, duration, rate, gaps in time, mount, ground truth, and
/// what the source itself has to say. Reads no image. A gap is a step in time longer than 2.5 times the
/// median step.
std::vector<std::pair<std::string, std::string>> describe(const ImageSource& source);

/// Horizontal and vertical angle that the camera sees, in degrees, distortion included.
std::pair<double, double> field_of_view_deg(const Camera& camera);

}  // namespace edgevo
