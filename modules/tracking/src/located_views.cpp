// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/located_views.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "edgevo/map/segment_join.h"

namespace edgevo {

bool LocatedViews::clear() { return !std::exchange(views_, {}).empty(); }

std::optional<CameraTurn> LocatedViews::turn_between(Timestamp begin, Timestamp end) const {
  const auto at = [&](Timestamp time) {
    return std::find_if(views_.begin(), views_.end(), [&](const auto& l) { return l.second.time == time; });
  };
  const auto a = at(begin), b = at(end);
  if (a == views_.end() || b == views_.end()) return std::nullopt;
  const LocatedPose &first = a->second.pose, &last = b->second.pose;
  const Eigen::Quaterniond R = (last.T_world_cam.inverse() * first.T_world_cam).rotation();
  const Eigen::Matrix3d of_first = first.covariance.bottomRightCorner<3, 3>();
  return CameraTurn{R, R.toRotationMatrix() * of_first * R.toRotationMatrix().transpose() +
                           last.covariance.bottomRightCorner<3, 3>()};
}

std::optional<SegmentPlaced> LocatedViews::place(int segment, const BootstrapResult& views) const {
  const auto distance = [](const auto& a, const BootstrapView& b) {
    return std::abs(a.first - b.frame_index);
  };
  // What a camera moves its view by from one frame to the next, radians.
  constexpr double kMoves = 0.025;
  std::optional<SegmentPlaced> placed;
  int nearest = std::numeric_limits<int>::max();
  for (const auto& located : views_)
    for (const BootstrapView& view : views.views)
      if (view.placed && distance(located, view) <= nearest) {
        nearest = distance(located, view);
        placed = locate_segment(segment, located.second.pose, view.T_cam_first, kFirstMedianDepth);
      }
  if (!placed || nearest == 0) return placed;
  placed->method = SegmentPlaced::Method::kDepthRatio;  // a guess
  placed->position_sigma += nearest * kMoves * kFirstMedianDepth * placed->T_world_map.scale;
  placed->rotation_sigma += nearest * kMoves;
  return placed;
}

}  // namespace edgevo
