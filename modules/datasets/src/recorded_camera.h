// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The camera of sensor_msgs/CameraInfo.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/input_decision.h"
#include "edgevo/recordings/messages.h"
#include "recording_topics.h"

namespace edgevo {

/// The camera for images of width x height. By ROS's definition K is for the full image, of which roi cut a
/// part whose pixels were then added up (binning); pixel centres are whole numbers. `is_rectified`: P without
/// distortion holds, as for topics named image_rect. What was decided is added to `decisions`. Throws
/// InputError opened by `where`: another lens, values that no camera has, images of another shape. Nullopt:
/// not calibrated (K is zero).
std::optional<Camera> camera_of_info(const CameraInfoMessage& info, bool is_rectified, int width, int height,
                                     const std::string& where, std::vector<InputDecision>* decisions);

/// Whether the name of a topic says that its images are rectified: image_rect, image_rect_color.
bool names_rectified(const std::string& topic);

/// CameraInfo of a topic with images: the topic camera_info next to it, else the only one of the same frame.
struct FoundCameraInfo {
  std::string topic;
  CameraInfoMessage message;
};
/// Nullopt: none. Throws InputError, opened by `path`, for a damaged one.
std::optional<FoundCameraInfo> find_camera_info(Recording* recording, const ImageTopic& image,
                                                const std::string& path);

}  // namespace edgevo
