// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The kinds of world. Each builds the surroundings of its scene's waypoints.
#include <string>

#include "scene_params.h"
#include "world_builder.h"

namespace edgevo {

/// Builds the world of `params`; the same parameters and seed give the same world. Throws InputError naming
/// the file and the line.
World build_world(const SceneParams& params, uint64_t seed);

/// Input of a builder of one kind of world.
struct Site {
  const SceneParams& params;
  WorldBuilder& build;
  /// Kinds of texture for walls.
  std::vector<std::string> walls;
  /// Seed of the scene, from which some worlds plan their path (room_plan.h).
  uint64_t seed = 0;
};

void build_street(Site& site);
/// A street without a turn whose second half is the mirror image of its first. Throws InputError if it turns.
void build_mirrored_street(Site& site);
void build_identical_doors(Site& site);
void build_desk(Site& site);
void build_lakeshore(Site& site);
void build_corridor(Site& site);
void build_plaza(Site& site);
void build_motorway(Site& site);
void build_tiled_rooms(Site& site);
void build_open_land(Site& site);
void build_parked_cars(Site& site);

}  // namespace edgevo
