// SPDX-License-Identifier: BSD-3-Clause
// A house: walls, roof, windows, door, chimney.
#include <algorithm>
#include <cmath>

#include "props.h"

namespace edgevo {
namespace {

constexpr double kStorey = 3.0;  // metres

// A window with a sill, its lower left corner at (r, z).
void add_window(WorldBuilder& b, const LocalFrame& place, double r, double z, double width, double height,
                int texture, int stone) {
  b.wall(place, r, r + width, z, z + height, 0.03, texture, false);
  b.box(place, {r - 0.1, r + width + 0.1, 0, 0.16, z - 0.1, z}, stone, stone, -1, true, 1.15f);
  b.box(place, {r - 0.06, r + width + 0.06, 0, 0.07, z + height, z + height + 0.14}, stone, stone, -1, true,
        1.05f);
}

void add_ground_floor(WorldBuilder& b, const LocalFrame& place, double width, int window, int stone) {
  Random& r = b.random();
  const double use = r.uniform();
  double from = 0.6;
  if (use < 0.25 && width > 7) {
    b.wall(place, 0.5, 6.0, 0.25, 3.0, 0.05, b.any_texture("shop", 6), false);
    b.box(place, {0.4, 6.1, 0, 0.9, 2.95, 3.05}, stone, stone, -1, true, 0.9f);
    from = 6.7;
  } else if (use < 0.45 && width > 6) {
    b.wall(place, 0.6, 3.2, 0, 2.4, 0.03, b.any_texture("garage", 4), false);
    from = 3.8;
  }
  const double door = from + (width - from - 1.6) * r.uniform(0.1, 0.8);
  if (width - from > 1.8) {
    b.wall(place, door, door + 1.15, 0.3, 2.6, 0.04, b.any_texture("door", 6), false);
    b.box(place, {door - 0.2, door + 1.35, 0, 0.5, 0, 0.3}, stone, stone);
  }
  for (double x = from; x + 1.2 < width - 0.4; x += 2.3)
    if (x + 1.3 < door - 0.2 || x > door + 1.4) add_window(b, place, x, 0.95, 1.2, 1.5, window, stone);
}

void add_upper_floors(WorldBuilder& b, const LocalFrame& place, double width, int storeys, int window,
                      int other, int stone) {
  Random& r = b.random();
  const double pitch = r.uniform(1.9, 2.7), w = r.uniform(0.95, 1.3), h = r.uniform(1.4, 1.8);
  const int count = std::max(1, int((width - 0.8) / pitch));
  const double margin = (width - (count - 1) * pitch - w) / 2;
  for (int storey = 1; storey < storeys; ++storey)
    for (int i = 0; i < count; ++i)
      add_window(b, place, margin + i * pitch, storey * kStorey + 0.85, w, h,
                 r.uniform() < 0.75 ? window : other, stone);
}

// Ridge along the front; the gables at both sides are two triangles each.
void add_gable_roof(WorldBuilder& b, const LocalFrame& place, double width, double depth, double eaves,
                    double rise, int tiles, int wall) {
  const Eigen::Vector3d ridge = place.point(-0.3, -depth / 2, eaves + rise),
                        right = (width + 0.6) * place.right;
  const double over = 0.4, drop = over * rise / (depth / 2);
  b.tile(ridge, right, place.point(-0.3, over, eaves - drop) - ridge, tiles);
  const Eigen::Vector3d back = ridge + right;
  b.tile(back, -right, place.point(width + 0.3, -depth - over, eaves - drop) - back, tiles);
  for (const double r : {0.0, width}) {
    const Eigen::Vector3d foot = place.point(r, -depth / 2, eaves), up(0, 0, rise);
    for (const double o : {0.0, -depth}) {
      Surface& gable = b.tile(foot, place.point(r, o, eaves) - foot, up, wall);
      gable.is_triangle = gable.is_two_sided = true;
    }
  }
}

void add_roof(WorldBuilder& b, const LocalFrame& place, double width, double depth, double eaves, int wall,
              int stone) {
  Random& r = b.random();
  if (r.uniform() < 0.3) {  // flat, with a cornice
    b.box(place, {-0.15, width + 0.15, -depth, 0.35, eaves, eaves + 0.35}, stone, stone);
    b.box(place, {0, width, -depth, 0, eaves + 0.35, eaves + r.uniform(0.6, 1.1)}, wall, stone);
    return;
  }
  const double rise = r.uniform(2.2, 4);
  add_gable_roof(b, place, width, depth, eaves, rise, b.any_texture("roof_tiles", 3), wall);
  const double at = r.uniform(0.15, 0.8) * width;
  b.box(place, {at, at + 0.7, -depth / 2 - 0.4, -depth / 2 + 0.3, eaves, eaves + rise + 0.9},
        b.any_texture("brick", 3), stone);
  b.box(place, {-0.3, width + 0.3, 0.3, 0.45, eaves - 0.42, eaves - 0.28}, b.texture("metal", 22),
        b.texture("metal", 22), -1, true, 0.6f);
}

}  // namespace

void add_house(WorldBuilder& b, const LocalFrame& place, double width, double depth, int storeys,
               const std::string& wall) {
  Random& r = b.random();
  const int skin = b.any_texture(wall, 3), stone = b.any_texture("concrete", 2);
  const int window = b.any_texture("window", 12), other = b.any_texture("window", 12);
  const double eaves = storeys * kStorey + 0.3;
  b.box(place, {0, width, -depth, 0, 0, eaves}, skin, skin, -1, true, float(r.uniform(0.75, 1.2)));
  // Plinth.
  b.box(place, {-0.02, width + 0.02, -0.2, 0.06, 0, r.uniform(0.25, 0.6)}, stone, stone, -1, true, 0.8f);
  if (r.uniform() < 0.5)
    b.box(place, {0, width, 0, 0.08, kStorey, kStorey + 0.2}, stone, stone);  // string course
  add_ground_floor(b, place, width, window, stone);
  add_upper_floors(b, place, width, storeys, window, other, stone);
  add_roof(b, place, width, depth, eaves, skin, stone);
  b.prism(place.moved(width - 0.15, 0.1, 0), 0.06, eaves, 5, b.texture("metal", 23), 0.7f);  // drain pipe
  for (const double side : {0.0, width}) {  // windows in the side walls
    const LocalFrame wall_place = side == 0 ? LocalFrame{place.point(0, -depth, 0), place.out, -place.right}
                                            : LocalFrame{place.point(width, 0, 0), -place.out, place.right};
    for (int storey = 0; storey < storeys; ++storey)
      for (double x = 1.5; x + 1.2 < depth; x += 3.4)
        if (r.uniform() < 0.5) add_window(b, wall_place, x, storey * kStorey + 0.95, 1.0, 1.4, other, stone);
  }
}

}  // namespace edgevo
