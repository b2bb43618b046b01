// SPDX-License-Identifier: BSD-3-Clause
#include "unit_move.h"

#include <iterator>
#include <map>

namespace edgevo {
namespace {

SE3 scaled(const SE3& T, double factor) { return {T.rotation(), factor * T.translation()}; }

// Poses of all keyframes of the segment, by id.
std::map<int, SE3> poses_of(const Map& map) {
  std::map<int, SE3> poses;
  for (const auto& [id, stored] : map.stored())
    if (stored.segment == map.segment()) poses[id] = stored.keyframe->T_world_cam.inverse();
  for (const Keyframe& k : map.active()) poses[k.id] = k.T_cam_world;
  return poses;
}

}  // namespace

MapMoved move_of_unit(const Map& map, int last_sure, double scale_ratio) {
  const std::map<int, SE3> poses = poses_of(map);
  const SE3 T_world_newest = map.active().back().T_cam_world.inverse();
  // The last sure keyframe, or the first of the segment if it is not known.
  const auto after = poses.upper_bound(last_sure);
  const SE3& T_sure_world = (after == poses.begin() ? after : std::prev(after))->second;
  const SE3 T_sure_newest = scaled(T_sure_world * T_world_newest, scale_ratio);
  MapMoved moved;
  moved.reason = MoveReason::kUnit;
  moved.segment = map.segment();
  moved.prior.emplace();
  for (const auto& [id, T_cam_world] : poses) {
    KeyframeMove move;
    move.id = id;
    if (id > last_sure) {
      move.T_cam_newest = scaled(T_cam_world * T_world_newest, scale_ratio);
      move.scale_ratio = scale_ratio;
    } else {
      move.T_cam_newest = T_cam_world * T_sure_world.inverse() * T_sure_newest;
    }
    moved.keyframes.push_back(std::move(move));
  }
  return moved;
}

}  // namespace edgevo
