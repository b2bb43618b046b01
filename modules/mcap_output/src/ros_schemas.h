// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace edgevo {

/// The definition of a ROS 2 message with those of all messages in it, as rosbag2 writes it. `name`:
/// "nav_msgs/msg/Odometry". Throws std::out_of_range for one that this program does not write.
std::string ros_schema(const std::string& name);

}  // namespace edgevo
