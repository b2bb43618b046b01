// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where the sensors of a vehicle are, from /tf_static.
#include <map>
#include <optional>
#include <string>

#include "edgevo/recordings/messages.h"

namespace edgevo {

/// A tree of frames that do not move against each other.
class StaticFrames {
 public:
  /// Adds a transform; one of the same child replaces it.
  void add(const TransformMessage& transform);
  /// p_parent = T p_child along the tree; nullopt if they are not connected.
  std::optional<SE3> between(const std::string& parent, const std::string& child) const;
  /// The frame of the vehicle: base_link, else base_footprint, else the root above `sensor`; empty if
  /// `sensor` is not in the tree.
  std::string vehicle_frame(const std::string& sensor) const;
  /// Whether there are none.
  bool empty() const { return links_.empty(); }

 private:
  struct Link {
    std::string parent;
    SE3 T_parent_child;
  };
  struct RootedFrame {
    std::string root;
    SE3 T_root_frame;
  };
  RootedFrame rooted(const std::string& frame) const;

  std::map<std::string, Link> links_;  // by child
};

}  // namespace edgevo
