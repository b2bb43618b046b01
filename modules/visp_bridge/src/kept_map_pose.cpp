// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/kept_map_pose.h"

#include <utility>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/tracking/frame_view.h"

namespace edgevo {

KeptMapPose KeptMapTracker::follow(const Odometry& odometry, bool is_found) {
  const NewestPose& newest = odometry.newest_pose();
  if (std::exchange(segment_, newest.segment) != newest.segment) agrees_ = contradicts_ = false;
  const bool has_own = is_found && newest.T_cam_map;
  if (newest.p_right < kDoubtfulBelow) agrees_ = false;
  if (has_own && agrees_) return {true, std::nullopt};
  const std::optional<LocatedPose> image = locator_.locate_newest(odometry.frame_view().pyramid);
  if (has_own && image) {
    agrees_ = is_same_pose(newest.T_world_odom * T_odom_cam(newest, *newest.T_cam_map), *image);
    contradicts_ = !agrees_;
  }
  if (has_own && !contradicts_) return {true, std::nullopt};
  return {false, image ? std::optional(image->T_world_cam) : std::nullopt};
}

}  // namespace edgevo
