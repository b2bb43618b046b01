// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// metadata.yaml of a ROS 2 bag, and the files of one whose recorder was killed before it wrote it.
#include <map>
#include <string>
#include <vector>

namespace edgevo {

/// What is used of metadata.yaml.
struct Ros2Metadata {
  /// Files in their order, relative to the folder.
  std::vector<std::string> files;
  /// Number of messages by the name of their topic.
  std::map<std::string, int64_t> messages;
  /// Whether each message is compressed by itself.
  bool has_packed_messages = false;
};

/// Parses metadata.yaml. Throws InputError opened by `where`: it is none, or names no files.
Ros2Metadata parse_ros2_metadata(const std::string& text, const std::string& where);

/// Names of the files of recordings in a folder, in the order of the numbers in their names.
std::vector<std::string> recorded_files(const std::string& folder);

/// Whether metadata.yaml in the folder is one of ROS 2.
bool has_ros2_metadata(const std::string& folder);

}  // namespace edgevo
