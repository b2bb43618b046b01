// SPDX-License-Identifier: BSD-3-Clause
#include "worlds.h"

#include <sstream>

#include "edgevo/core/error.h"
#include "light_change.h"
#include "texture_kinds.h"

namespace edgevo {
namespace {

std::vector<std::string> wall_kinds(const std::string& list, const std::string& where) {
  std::istringstream in(list);
  std::vector<std::string> kinds;
  for (std::string kind; in >> kind;) {
    texture_kind(kind, where);
    kinds.push_back(kind);
  }
  if (kinds.empty())
    throw InputError(where, "world.walls names no texture", "write for example walls: brick plaster");
  return kinds;
}

}  // namespace

World build_world(const SceneParams& params, uint64_t seed) {
  const WorldParams& w = params.world;
  WorldBuilder builder(seed, params.where.sky, sun_direction(w.sun_azimuth_deg, w.sun_elevation_deg));
  Site site{params, builder, wall_kinds(w.walls, params.where.walls), seed};
  builder.set_sky(w.sky, float(w.horizon_gray), float(w.haze_per_metre));
  if (w.kind == "street") build_street(site);
  if (w.kind == "mirrored_street") build_mirrored_street(site);
  if (w.kind == "identical_doors") build_identical_doors(site);
  if (w.kind == "desk") build_desk(site);
  if (w.kind == "lakeshore") build_lakeshore(site);
  if (w.kind == "corridor") build_corridor(site);
  if (w.kind == "plaza") build_plaza(site);
  if (w.kind == "motorway") build_motorway(site);
  if (w.kind == "tiled_rooms") build_tiled_rooms(site);
  if (w.kind == "open_land") build_open_land(site);
  if (w.kind == "parked_cars") build_parked_cars(site);
  return builder.finish();
}

}  // namespace edgevo
