// SPDX-License-Identifier: BSD-3-Clause
// Walls, roofs and hedges: tiled, four metres a repeat.
#include <algorithm>
#include <cmath>

#include "texture_kinds.h"

namespace edgevo {
namespace {

constexpr int kSize = 512;

// Courses of blocks with joints between them; every other course is shifted by half a block.
Canvas masonry(Random& random, int courses, int blocks, double joint, float block, float mortar,
               float spread) {
  Canvas c(kSize, kSize, mortar);
  c.noise(random, 16, 5, 14);
  const double h = double(kSize) / courses, w = double(kSize) / blocks;
  for (int row = 0; row < courses; ++row)
    for (int i = 0; i < blocks; ++i) {
      const double x = (i + 0.5 * (row % 2)) * w, y = row * h;
      const double slack = 0.25 * joint;
      const float odd = random.uniform() < 0.06 ? 2.2f : 1.0f;  // some stand out
      c.rect(x + joint / 2 + random.uniform(0, slack), y + joint / 2 + random.uniform(0, slack),
             x + w - joint / 2 - random.uniform(0, slack), y + h - joint / 2 - random.uniform(0, slack),
             block + odd * spread * float(random.uniform(-1, 1)), 0.93f);
    }
  c.noise(random, 2, 8, 34, 0.72f);
  c.grain(random, 5);
  return c;
}

// Joints are a little lighter than the bricks: worn, not freshly pointed.
Canvas brick_wall(Random& random) {
  const float block = float(random.uniform(80, 125));
  return masonry(random, 52, 16, 1.8, block, block + float(random.uniform(22, 42)), 13);
}

// Streaks of dirt left by rain.
void streaks(Canvas* c, Random& random, int count, float strength) {
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(0, c->width()), y = random.uniform(0, c->height());
    const double length = random.uniform(0.1, 0.5) * c->height();
    c->line(x, y, x + random.uniform(-3, 3), y + length, random.uniform(1, 7), float(random.uniform(40, 90)),
            strength * float(random.uniform(0.2, 1)));
  }
}

void crack(Canvas* c, Random& random, double length) {
  double x = random.uniform(0, c->width()), y = random.uniform(0, c->height()),
         heading = random.uniform(0, 6.283);
  for (double s = 0; s < length; s += 8) {
    const double nx = x + 8 * std::cos(heading), ny = y + 8 * std::sin(heading);
    c->line(x, y, nx, ny, 1.2, 40, 0.7f);
    x = nx, y = ny, heading += random.uniform(-0.7, 0.7);
  }
}

Canvas plaster(Random& random) {
  Canvas c(kSize, kSize, float(random.uniform(120, 200)));
  c.noise(random, 3, 8, 45, 0.75f);
  c.grain(random, 6);
  streaks(&c, random, 18, 0.25f);
  for (int i = 0; i < 4; ++i) crack(&c, random, random.uniform(60, 260));
  for (int i = 0; i < 5; ++i)  // where plaster has come off
    for (int k = 0, n = 6 + random.below(10); k < n; ++k) {
      const double x = 100.0 * i + random.uniform(0, 40), y = 97.0 * i + random.uniform(0, 60);
      c.ellipse(x, y, random.uniform(3, 14), random.uniform(3, 10), random.uniform(0, 3), 85, 0.8f);
    }
  return c;
}

Canvas boards(Random& random) {
  Canvas c(kSize, kSize, float(random.uniform(90, 170)));
  const int count = 20;
  const double h = double(kSize) / count;
  for (int i = 0; i < count; ++i) {
    const float tone = c.at(0, int(i * h)) + float(random.uniform(-14, 14));
    c.rect(0, i * h, kSize, (i + 1) * h, tone);
    for (int k = 0; k < 14; ++k)
      c.line(random.uniform(0, kSize), i * h + random.uniform(2, h - 2), random.uniform(0, kSize),
             i * h + random.uniform(2, h - 2), 1, tone - 25, 0.4f);
    c.rect(0, (i + 1) * h - 2.5, kSize, (i + 1) * h, 45, 0.6f);
    const double joint = random.uniform(0, kSize);
    c.rect(joint, i * h, joint + 1.5, (i + 1) * h, 40, 0.8f);
  }
  c.noise(random, 4, 7, 25, 0.7f);
  c.grain(random, 5);
  return c;
}

Canvas concrete(Random& random) {
  Canvas c(kSize, kSize, float(random.uniform(120, 160)));
  c.noise(random, 3, 8, 40, 0.75f);
  streaks(&c, random, 30, 0.3f);
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      c.rect(i * 256.0, 0, i * 256.0 + 4, kSize, 60, 0.8f);
      c.rect(0, k * 256.0, kSize, k * 256.0 + 4, 60, 0.8f);
      for (int a = 0; a < 4; ++a)  // holes left by the formwork
        c.ellipse(i * 256 + 64 + 128 * (a & 1), k * 256 + 64 + 128 * (a >> 1), 5, 5, 0, 45, 0.9f);
    }
  crack(&c, random, 300);
  c.grain(random, 6);
  return c;
}

Canvas roof_tiles(Random& random) {
  Canvas c(kSize, kSize, 70);
  const int rows = 16, columns = 20;
  const double h = double(kSize) / rows, w = double(kSize) / columns;
  for (int r = 0; r < rows; ++r)
    for (int i = 0; i < columns; ++i) {
      const double x = (i + 0.5 * (r % 2)) * w, y = r * h;
      const float tone = 95 + float(random.uniform(-22, 22));
      c.rect(x + 1, y, x + w - 1, y + h * 0.8, tone);
      c.ellipse(x + w / 2, y + h * 0.75, w / 2 - 1, h * 0.2, 0, tone + 12);
    }
  c.noise(random, 3, 7, 26, 0.7f);
  c.grain(random, 4);
  return c;
}

Canvas hedge(Random& random) {
  Canvas c(kSize, kSize, 45);
  c.noise(random, 4, 6, 18);
  for (int i = 0; i < 5200; ++i) {
    const double size = random.uniform(2.5, 6);
    c.ellipse(random.uniform(0, kSize), random.uniform(0, kSize), size, size * random.uniform(0.35, 0.7),
              random.uniform(0, 3.1416),
              float(random.uniform(35, 50) + 60 * std::pow(random.uniform(), 2) * i / 5200), 0.8f);
  }
  c.noise(random, 3, 4, 22);
  return c;
}

}  // namespace

std::vector<TextureKind> wall_textures() {
  return {
      {"brick", 4, 4, brick_wall, Thing::kBuilding},
      {"stone", 4, 4,
       [](Random& r) {
         return masonry(r, 14, 8, 4.0, float(r.uniform(120, 148)), float(r.uniform(96, 112)), 12);
       },
       Thing::kBuilding},
      {"plaster", 4, 4, plaster, Thing::kBuilding},
      {"boards", 4, 4, boards, Thing::kBuilding},
      {"concrete", 4, 4, concrete, Thing::kBuilding},
      {"roof_tiles", 4, 4, roof_tiles, Thing::kBuilding},
      {"hedge", 4, 4, hedge, Thing::kPlant},
  };
}

}  // namespace edgevo
