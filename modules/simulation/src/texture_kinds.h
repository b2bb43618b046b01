#pragma once
// The kinds of texture that worlds are built of, by name. Each draws from its own stream of random numbers.
#include <functional>
#include <string>
#include <vector>

#include "canvas.h"

namespace edgevo {

struct TextureKind {
  std::string name;
  double width_m, height_m;  ///< size of one repeat where it is tiled, and natural size where it is not
  std::function<Canvas(Random&)> draw;
};

std::vector<TextureKind> wall_textures();    // brick, plaster, stone, boards, concrete, roof_tiles, hedge
std::vector<TextureKind> front_textures();   // window, door, shop, garage, sign, poster
std::vector<TextureKind> ground_textures();  // asphalt, slabs, grass, carpet, wood, water, tiles, ...
std::vector<TextureKind> nature_textures();  // bark, leaves, conifer, bush, reeds, clouds, rock
std::vector<TextureKind>
object_textures();  // car_side, car_front, car_top, glass, screen, keyboard, paper, book, ...

/// All of them; names are unique.
const std::vector<TextureKind>& texture_kinds();

/// The kind of that name. Throws InputError naming `where` and the nearest name.
const TextureKind& texture_kind(const std::string& name, const std::string& where);

}  // namespace edgevo
