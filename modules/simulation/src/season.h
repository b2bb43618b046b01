#pragma once
// What a season does to the plants of a world and to its light. Without one everything stands in full leaf,
// under the light of the scene.
#include <string>

namespace edgevo {

struct WorldParams;

struct Leaves {
  const char* state = "";  ///< "", "thin" or "bare": which textures crowns, bushes and woods have
  float gain = 1;          ///< brightness

  /// Behind the name of a texture.
  std::string suffix() const { return *state ? std::string("_") + state : std::string(); }
};

struct SeasonLook {
  Leaves leaves;
  float grass_gain = 1, reed_gain = 1, water_gain = 1;
  double sun_elevation_deg = 0;  ///< at noon, of a lake at 49 degrees north
  double haze_per_metre = 0;     ///< mist in autumn
};

/// "spring", "summer", "autumn" or "winter"; anything else: no season.
const SeasonLook& season_look(const std::string& season);

/// Sets sun and haze to those of world.season, if it has one.
void apply_season(WorldParams* world);

}  // namespace edgevo
