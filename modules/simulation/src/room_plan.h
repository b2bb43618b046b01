// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ground plan of a walk through rooms: rectangles joined by doorways, and a path with a turn in each room.
#include <cstdint>
#include <string>
#include <vector>

#include "scene_params.h"
#include "world_builder.h"

namespace edgevo {

/// Sides of a room, counted to the left from the east.
enum RoomSide { kEast, kNorth, kWest, kSouth };

/// An opening in the wall of a room.
struct Doorway {
  int side;
  /// Position of its middle along the wall, in x or y, and its size, metres.
  double middle, width, height;
};

/// A room between x0 and x1, y0 and y1, metres.
struct Room {
  double x0, x1, y0, y1, height;
  /// The doorways through which the path comes in and goes out; the first room has no way in, the last one no
  /// way out.
  std::vector<Doorway> doorways;

  double length(int side) const { return side == kEast || side == kWest ? y1 - y0 : x1 - x0; }
  /// Frame of a wall as seen from inside, with its origin at the left end.
  LocalFrame wall(int side) const;
  /// Position along wall() of a doorway's left end.
  double left_end(const Doorway& d) const;
};

struct RoomPlan {
  std::vector<Room> rooms;
  /// Thickness of the walls, metres.
  double wall_m = 0;
  std::vector<Eigen::Vector3d> waypoints;
  /// Number of frames of the walk.
  int frames = 0;
};

/// The rooms of that seed, with a walk as fast and with turns as wide as params.motion says; waypoints and
/// frames of `params` play no part. Throws InputError, opened by `where`, if no walk fits.
RoomPlan plan_rooms(const SceneParams& params, uint64_t seed, const std::string& where);

}  // namespace edgevo
