// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// ROS 1 bags, format 2.0 (wiki.ros.org/Bags/Format/2.0).
//
//   "#ROSBAG V2.0\n", bag header (padded to 4096 bytes); chunks, each followed by its index; connections and
//   chunk infos at index_pos. A record: length and fields `name=value` of its header, length and bytes of its
//   data. Chunks hold connections and messages.
#include <memory>
#include <string>

#include "edgevo/recordings/recording.h"

namespace edgevo {

/// Opens a bag. Throws InputError as open_recording().
std::unique_ptr<Recording> open_ros1_bag(const std::string& path);

}  // namespace edgevo
