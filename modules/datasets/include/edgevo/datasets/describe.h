// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What `edgevo info` prints about a source or a camera file: names and values, in order.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Kind, frames, image size, camera, field of view, duration, rate, gaps in time, mount, ground truth, and
/// the source's decisions and own details. A camera that is not known has no numbers. Reads no image. A gap
/// is a time step longer than 2.5 times the median step.
std::vector<std::pair<std::string, std::string>> describe(const ImageSource& source);

/// Image size, focal lengths on the axis, distortion, field of view.
std::vector<std::pair<std::string, std::string>> describe_numbers(const Camera& camera);

/// The same, where the lens shows angles, how it bends straight lines, the pinhole that a run rectifies to,
/// and a warning about values that no camera has.
std::vector<std::pair<std::string, std::string>> describe(const Camera& camera);

/// Horizontal and vertical field of view in degrees, distortion included.
std::pair<double, double> field_of_view_deg(const Camera& camera);

}  // namespace edgevo
