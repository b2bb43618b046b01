// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What `edgevo info` prints about a source or a camera file: names and values, in order.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Kind, frames, image size, camera, field of view, duration, rate, gaps in time, mount, ground truth, and
/// the source's decisions and own details. A camera that is not known has no numbers. Reads no image. A gap
/// is a time step longer than 2.5 times the median step.
std::vector<std::pair<std::string, std::string>> describe(const ImageSource& source);

/// What to report about a source, as name and value: scaling of its images.
std::vector<std::pair<std::string, std::string>> source_notices(const ImageSource& source);

/// What was decided about the input at `path`, a line each, then the doubts as warnings.
std::vector<std::string> decision_lines(const std::string& path, const std::vector<InputDecision>& decisions);

/// The notices and decisions of a source that was opened from `path`, a line each.
std::vector<std::string> opening_lines(const std::string& path, const ImageSource& source);

/// The frames of `source` that a run would skip, one line each with the reason. A source that cannot go on
/// after a fault throws it. `on_frame` is called with the number of frames so far.
std::vector<std::string> find_bad_frames(ImageSource& source, const std::function<void(int)>& on_frame,
                                         int* frames);

/// Whether the name is that of a camera file, not of a video or a rawlog.
bool names_camera_file(const std::string& path);

/// Image size, focal lengths on the axis, distortion, field of view.
std::vector<std::pair<std::string, std::string>> describe_numbers(const Camera& camera);

/// The same, where the lens shows angles, how it bends straight lines, the pinhole that a run rectifies to,
/// and a warning about values that no camera has.
std::vector<std::pair<std::string, std::string>> describe(const Camera& camera);

/// Horizontal and vertical field of view in degrees, distortion included.
std::pair<double, double> field_of_view_deg(const Camera& camera);

}  // namespace edgevo
