// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/recordings/static_frames.h"

namespace edgevo {

void StaticFrames::add(const TransformMessage& transform) {
  if (transform.T.is_finite() && transform.child_frame != transform.header.frame)
    links_[transform.child_frame] = {transform.header.frame, transform.T};
}

// Stops where a tree that is none would lead round in circles.
StaticFrames::RootedFrame StaticFrames::rooted(const std::string& frame) const {
  RootedFrame found{frame, SE3()};
  for (size_t steps = 0; steps < links_.size(); ++steps) {
    const auto link = links_.find(found.root);
    if (link == links_.end()) break;
    found = {link->second.parent, link->second.T_parent_child * found.T_root_frame};
  }
  return found;
}

std::optional<SE3> StaticFrames::between(const std::string& parent, const std::string& child) const {
  const RootedFrame a = rooted(parent), b = rooted(child);
  if (a.root != b.root) return std::nullopt;
  return a.T_root_frame.inverse() * b.T_root_frame;
}

std::string StaticFrames::vehicle_frame(const std::string& sensor) const {
  if (links_.count(sensor) == 0) return {};
  for (const char* name : {"base_link", "base_footprint"})
    if (between(name, sensor)) return name;
  return rooted(sensor).root;
}

}  // namespace edgevo
