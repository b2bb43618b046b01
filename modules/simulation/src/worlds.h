#pragma once
// The kinds of world. Each builds what stands around the way points of its scene.
#include <string>

#include "scene_params.h"
#include "world_builder.h"

namespace edgevo {

/// Grows the world of `params`; the same parameters and seed give the same world. Throws InputError naming
/// the file and the line.
World build_world(const SceneParams& params, uint64_t seed);

/// What a builder of one kind works with.
struct Site {
  const SceneParams& params;
  WorldBuilder& build;
  std::vector<std::string> walls;  ///< kinds of texture for walls
};

void build_street(Site& site);
void build_desk(Site& site);
void build_lakeshore(Site& site);
void build_corridor(Site& site);
void build_plaza(Site& site);

}  // namespace edgevo
