// SPDX-License-Identifier: BSD-3-Clause
#include "season.h"

#include <map>

#include "scene_params.h"

namespace edgevo {

// Leaves: young and bright; full and dark; few and yellow; none. The sun at 49 degrees north is 41 degrees
// high at noon in April, 62 in July, 32 in October, 20 in January; low light leaves the water dark. Reeds are
// dry and pale from autumn to spring.
const SeasonLook& season_look(const std::string& season) {
  static const SeasonLook kNone;
  static const std::map<std::string, SeasonLook> kLooks{
      {"spring", {{"thin", 1.3f}, 1.1f, 1.2f, 1.0f, 41, 0.002}},
      {"summer", {{"", 0.95f}, 1.0f, 1.0f, 1.05f, 62, 0.002}},
      {"autumn", {{"thin", 1.6f}, 0.9f, 1.15f, 0.9f, 32, 0.004}},
      {"winter", {{"bare", 1.0f}, 0.8f, 1.3f, 0.8f, 20, 0.003}},
  };
  const auto it = kLooks.find(season);
  return it == kLooks.end() ? kNone : it->second;
}

void apply_season(WorldParams* world) {
  const SeasonLook& look = season_look(world->season);
  if (look.sun_elevation_deg == 0) return;
  world->sun_elevation_deg = look.sun_elevation_deg;
  world->haze_per_metre = look.haze_per_metre;
}

}  // namespace edgevo
