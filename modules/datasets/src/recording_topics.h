// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The topics with images of a recording of ROS, and which of them is taken.
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"
#include "edgevo/recordings/recording.h"

namespace edgevo {

/// What the first messages of a topic with images show.
struct ImageTopic {
  /// Position in Recording::topics().
  size_t topic = 0;
  /// "/camera/image_raw".
  std::string name;
  /// Whether its messages hold image files (sensor_msgs/CompressedImage).
  bool is_compressed = false;
  Serialization serialization = Serialization::kRos1;
  /// Encoding or format, size in pixels and frame of the first image.
  std::string encoding, frame;
  int width = 0, height = 0;
  /// Stamps in the headers of the first images, and when these were recorded.
  std::vector<Timestamp> stamps, recorded;
  /// Number of images, if known.
  std::optional<int64_t> images;
  /// Why it cannot be used, as a message of InputError; empty: it can.
  std::string problem;

  /// Whether its headers hold no stamps.
  bool has_no_stamps() const;
  /// Median time from image to image by the headers, or as recorded if these have none; seconds, 0: one
  /// image.
  double step_s() const;
};

/// The topic of that name, or the only one with images that can be used if `name` is empty. Throws
/// InputError: none, several (with their counts, rates and sizes), no such topic, no images.
ImageTopic choose_image_topic(Recording* recording, const std::string& path, const std::string& name);

/// "/camera/image_raw (sensor_msgs/Image, 1200), ...": all topics with their types and counts.
std::string list_topics(const Recording& recording);

}  // namespace edgevo
