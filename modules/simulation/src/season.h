// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Effect of a season on the plants of a world and on its light. Without one all plants are in full leaf,
// under the light of the scene.
#include <string>

namespace edgevo {

struct WorldParams;

struct Leaves {
  /// Textures of crowns, bushes and woods: "", "thin" or "bare".
  const char* state = "";
  /// Brightness factor.
  float gain = 1;

  /// Suffix of the texture's name.
  std::string suffix() const { return *state ? std::string("_") + state : std::string(); }
};

struct SeasonLook {
  Leaves leaves;
  float grass_gain = 1, reed_gain = 1, water_gain = 1;
  /// Elevation of the sun at noon on a lake at 49 degrees north, degrees.
  double sun_elevation_deg = 0;
  /// Haze, for the mist of autumn.
  double haze_per_metre = 0;
};

/// Look of "spring", "summer", "autumn" or "winter"; anything else: no season.
const SeasonLook& season_look(const std::string& season);

/// Sets sun and haze to those of world.season, if it is set.
void apply_season(WorldParams* world);

}  // namespace edgevo
