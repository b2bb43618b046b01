// SPDX-License-Identifier: BSD-3-Clause
// Surfaces on which there is little to see: tiles, panels, paint, smooth roads, meadows. Sizes and contrasts
// are drawn over a wide range.
#include <algorithm>
#include <cmath>

#include "texture_kinds.h"

namespace edgevo {
namespace {

constexpr int kPlainSize = 1024;  // texels

// A grid of fields between joints, in texels.
struct Grid {
  int columns, rows;
  double joint;
  float field, gap, spread;
  bool is_shifted;  // every other row by half a field
};

void draw_grid(Canvas* c, Random& random, const Grid& g) {
  const double w = double(c->width()) / g.columns, h = double(c->height()) / g.rows;
  c->rect(0, 0, c->width(), c->height(), g.gap);
  for (int row = 0; row < g.rows; ++row)
    for (int i = 0; i < g.columns; ++i) {
      const double x = (i + (g.is_shifted && row % 2 ? 0.5 : 0.0)) * w, y = row * h;
      const float tone = g.field + g.spread * float(random.uniform(-1, 1));
      c->rect(x + g.joint / 2, y + g.joint / 2, x + w - g.joint / 2, y + h - g.joint / 2, tone);
    }
}

// Specks and scuffs, down to none.
void wear(Canvas* c, Random& random, int most) {
  for (int i = 0, n = random.below(most); i < n; ++i) {
    const double x = random.uniform(0, c->width()), y = random.uniform(0, c->height());
    const double a = random.uniform(0.8, 4), b = random.uniform(0.8, 4);
    c->ellipse(x, y, a, b, random.uniform(0, 3), float(random.uniform(60, 210)), 0.5f);
  }
  for (int i = 0, n = random.below(most / 12 + 1); i < n; ++i) {
    const double x = random.uniform(0, c->width()), y = random.uniform(0, c->height());
    const double dx = random.uniform(-60, 60), dy = random.uniform(-25, 25);
    c->line(x, y, x + dx, y + dy, random.uniform(1, 3), float(random.uniform(70, 160)), 0.3f);
  }
}

void finish_plain(Canvas* c, Random& random, float stains) {
  c->noise(random, 2, 7, stains, 0.6f);
  c->grain(random, float(random.uniform(1, 3)));
}

// A joint that is darker than its fields, mostly.
float gap_for(Random& random, float field) {
  const float darker = float(random.uniform(25, 130));
  return random.uniform() < 0.88 ? field - darker : std::min(250.0f, field + 0.3f * darker);
}

Canvas white_tiles(Random& random) {
  Canvas c(kPlainSize, kPlainSize, 200);
  const int counts[] = {8, 10, 12, 16, 20};
  const int count = counts[random.below(5)];
  const float field = float(random.uniform(165, 205));
  const double joint = random.uniform(1.2, 3);
  const float gap = gap_for(random, field), spread = float(random.uniform(0.5, 6));
  draw_grid(&c, random, {count, count, joint, field, gap, spread, random.uniform() < 0.25});
  wear(&c, random, 60);
  finish_plain(&c, random, float(random.uniform(3, 10)));
  return c;
}

Canvas floor_slabs(Random& random) {
  Canvas c(kPlainSize, kPlainSize, 150);
  const int count = 4 + 2 * random.below(5);
  const float field = float(random.uniform(105, 205));
  const double joint = random.uniform(1.5, 4);
  const float gap = gap_for(random, field), spread = float(random.uniform(1, 9));
  draw_grid(&c, random, {count, count, joint, field, gap, spread, random.uniform() < 0.2});
  wear(&c, random, 160);
  finish_plain(&c, random, float(random.uniform(4, 14)));
  return c;
}

// Each joint has a light rim along it, as where light falls on a bevel.
Canvas wall_panels(Random& random) {
  Canvas c(kPlainSize, kPlainSize, 200);
  const int columns = 2 + random.below(4), rows = 2 + 2 * random.below(2);
  const float field = float(random.uniform(170, 208));
  const double joint = random.uniform(2.5, 6);
  draw_grid(&c, random,
            {columns, rows, joint, field, gap_for(random, field), float(random.uniform(0, 5)), false});
  for (int i = 0; i < columns; ++i)
    c.rect(i * double(kPlainSize) / columns + joint / 2, 0,
           i * double(kPlainSize) / columns + joint / 2 + 1.5, kPlainSize, field + 20, 0.6f);
  wear(&c, random, 40);
  finish_plain(&c, random, float(random.uniform(3, 9)));
  return c;
}

Canvas ceiling_panels(Random& random) {
  Canvas c(512, 512, 190);
  const float field = float(random.uniform(165, 215));
  draw_grid(&c, random, {5, 5, random.uniform(2, 4), field, gap_for(random, field), 3, false});
  const double speck = random.uniform(0.8, 1.6);
  for (int i = 0, n = random.below(2500); i < n; ++i) {
    const double x = random.uniform(0, 512), y = random.uniform(0, 512);
    c.ellipse(x, y, speck, speck, 0, field - 45, 0.6f);
  }
  finish_plain(&c, random, 4);
  return c;
}

Canvas painted_wall(Random& random) {
  Canvas c(kPlainSize, kPlainSize, float(random.uniform(125, 215)));
  wear(&c, random, 90);
  finish_plain(&c, random, float(random.uniform(5, 14)));
  return c;
}

void wandering_crack(Canvas* c, Random& random, double length, float gray) {
  double x = random.uniform(0, c->width()), y = random.uniform(0, c->height()),
         heading = random.uniform(0, 6.283);
  for (double s = 0; s < length; s += 12) {
    const double nx = x + 12 * std::cos(heading), ny = y + 12 * std::sin(heading);
    c->line(x, y, nx, ny, 2, gray, 0.6f);
    x = nx, y = ny, heading += random.uniform(-0.5, 0.5);
  }
}

Canvas worn_asphalt(Random& random) {
  const float tone = float(random.uniform(85, 135));
  Canvas c(kPlainSize, kPlainSize, tone);
  c.noise(random, 2, 9, float(random.uniform(10, 26)), 0.68f);
  for (int i = 0, n = random.below(4); i < n; ++i) {
    const double x = random.uniform(0, kPlainSize), y = random.uniform(0, kPlainSize);
    const double w = random.uniform(60, 260), h = random.uniform(60, 300);
    c.rect(x, y, x + w, y + h, tone + float(random.uniform(-25, 20)), 0.4f);
  }
  for (int i = 0, n = random.below(6); i < n; ++i)
    wandering_crack(&c, random, random.uniform(150, 700), tone - float(random.uniform(25, 60)));
  c.grain(random, float(random.uniform(2, 7)));
  return c;
}

Canvas meadow(Random& random) {
  const int n = 512;
  const float tone = float(random.uniform(70, 125)), contrast = float(random.uniform(12, 40));
  Canvas c(n, n, tone);
  c.noise(random, 2, 7, float(random.uniform(12, 28)), 0.7f);
  for (int i = 0; i < 5000; ++i) {
    const double x = random.uniform(0, n), y = random.uniform(0, n);
    const double lean = random.uniform(-4, 4), height = random.uniform(2, 8);
    c.line(x, y, x + lean, y - height, 1.2, tone + contrast * float(random.uniform(-1, 1)), 0.6f);
  }
  return c;
}

}  // namespace

std::vector<TextureKind> plain_textures() {
  return {{"white_tiles", 3.2, 3.2, white_tiles, Thing::kBuilding},
          {"floor_slabs", 3.2, 3.2, floor_slabs, Thing::kGround},
          {"wall_panels", 3.2, 3.2, wall_panels, Thing::kBuilding},
          {"ceiling_panels", 3, 3, ceiling_panels, Thing::kBuilding},
          {"painted_wall", 5, 5, painted_wall, Thing::kBuilding},
          {"worn_asphalt", 10, 10, worn_asphalt, Thing::kGround},
          {"meadow", 8, 8, meadow, Thing::kGround}};
}

}  // namespace edgevo
