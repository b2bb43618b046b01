// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A taught pose that outlives the program that it was taught to: OUT/goal.txt, with the map that it lies in,
// OUT/map.db.
#include <memory>
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/places/place_store.h"

namespace edgevo {

/// A taught pose.
struct KeptGoal {
  /// Pose of the taught camera in the world of the map, in its unit.
  SE3 T_map_taught;
  /// Metres per unit of the map.
  double metres_per_unit = 1;
};

/// What a loop leaves to those after it.
struct KeptLoop {
  /// The goal.
  KeptGoal goal;
  /// The run of the loop.
  Run run;
  /// Its keyframes with what is remembered of their views.
  std::vector<StoredKeyframe> keyframes;
};

/// Writes both files into a folder. Throws InputError: a disk that is full.
void write_kept_loop(const KeptLoop& loop, const std::string& folder);
/// Reads the goal of a folder. Throws InputError if it is not there or damaged.
KeptGoal read_kept_goal(const std::string& folder);
/// Reads the places of a folder's map. Throws InputError as read_finished_map().
std::shared_ptr<const PlaceStore> read_kept_places(const std::string& folder, const Pinhole& pinhole);

}  // namespace edgevo
