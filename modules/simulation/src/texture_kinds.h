// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The kinds of texture used by worlds, by name. Each draws from its own stream of random numbers.
#include <functional>
#include <string>
#include <vector>

#include "canvas.h"
#include "edgevo/simulation/world.h"

namespace edgevo {

struct TextureKind {
  std::string name;
  /// Size of one repeat of a tiled texture, else the natural size, metres.
  double width_m, height_m;
  std::function<Canvas(Random&)> draw;
  /// What its surfaces are part of, unless their builder says otherwise.
  Thing thing = Thing::kObject;
};

/// Kinds brick, plaster, stone, boards, concrete, roof_tiles, hedge.
std::vector<TextureKind> wall_textures();
/// Kinds window, door, shop, garage, sign, poster.
std::vector<TextureKind> front_textures();
/// Kinds asphalt, slabs, grass, carpet, wood, water, tiles, ...
std::vector<TextureKind> ground_textures();
/// Kinds bark, leaves, conifer, bush, reeds, clouds, rock.
std::vector<TextureKind> nature_textures();
/// Kinds car_side, car_front, car_top, glass, screen, keyboard, paper, book, ...
std::vector<TextureKind> object_textures();

/// Kinds lorry_rear, bus_side, person (foreign_bodies.cpp).
std::vector<TextureKind> body_textures();

/// Kinds white_tiles, floor_slabs, wall_panels, ceiling_panels, painted_wall, worn_asphalt, meadow, whose
/// sizes and contrasts are drawn, down to hardly any.
std::vector<TextureKind> plain_textures();

/// All kinds; names are unique.
const std::vector<TextureKind>& texture_kinds();

/// The kind of that name. Throws InputError naming `where` and the nearest name.
const TextureKind& texture_kind(const std::string& name, const std::string& where);

}  // namespace edgevo
