// SPDX-License-Identifier: BSD-3-Clause
// Grounds and table tops; tiled.
#include <cmath>

#include "texture_kinds.h"

namespace edgevo {
namespace {

void wander(Canvas* c, Random& random, double length, double width, float gray, float opacity) {
  double x = random.uniform(0, c->width()), y = random.uniform(0, c->height()),
         heading = random.uniform(0, 6.283);
  for (double s = 0; s < length; s += 10) {
    const double nx = x + 10 * std::cos(heading), ny = y + 10 * std::sin(heading);
    c->line(x, y, nx, ny, width * random.uniform(0.6, 1.4), gray, opacity);
    x = nx, y = ny, heading += random.uniform(-0.6, 0.6);
  }
}

Canvas asphalt(Random& random) {
  const int n = 1024;
  Canvas c(n, n, 108);
  c.noise(random, 2, 9, 40, 0.72f);
  c.grain(random, 9);
  for (int i = 0; i < 7; ++i) {  // patches of other age
    const double x = random.uniform(0, n), y = random.uniform(0, n), w = random.uniform(60, 260),
                 h = random.uniform(60, 300);
    c.rect(x, y, x + w, y + h, float(random.uniform(75, 135)), 0.45f);
    c.rect(x, y, x + w, y + 3, 55, 0.6f), c.rect(x, y, x + 3, y + h, 55, 0.6f);
  }
  for (int i = 0; i < 9; ++i) wander(&c, random, random.uniform(150, 900), 2.5, 45, 0.75f);
  for (int i = 0; i < 4; ++i) wander(&c, random, random.uniform(200, 700), 7, 60, 0.6f);  // sealed cracks
  for (int i = 0; i < 60; ++i)
    c.ellipse(random.uniform(0, n), random.uniform(0, n), random.uniform(2, 14), random.uniform(2, 9),
              random.uniform(0, 3), float(random.uniform(60, 150)), 0.35f);
  return c;
}

Canvas slabs(Random& random) {
  const int n = 512, count = 8;
  Canvas c(n, n, 92);
  for (int y = 0; y < count; ++y)
    for (int x = 0; x < count; ++x)
      c.rect(x * 64 + 1.5, y * 64 + 1.5, x * 64 + 62.5, y * 64 + 62.5, 140 + float(random.uniform(-11, 11)));
  c.noise(random, 2, 8, 32, 0.72f);
  c.grain(random, 6);
  for (int i = 0; i < 40; ++i)
    c.ellipse(random.uniform(0, n), random.uniform(0, n), random.uniform(1, 5), random.uniform(1, 4), 0, 65,
              0.6f);
  return c;
}

Canvas grass(Random& random) {
  const int n = 512;
  Canvas c(n, n, 78);
  c.noise(random, 3, 7, 35, 0.7f);
  for (int i = 0; i < 9000; ++i) {
    const double x = random.uniform(0, n), y = random.uniform(0, n);
    c.line(x, y, x + random.uniform(-5, 5), y - random.uniform(3, 12), 1.2, float(random.uniform(45, 135)),
           0.7f);
  }
  return c;
}

Canvas gravel(Random& random) {
  const int n = 512;
  Canvas c(n, n, 95);
  for (int i = 0; i < 7000; ++i) {
    const double a = random.uniform(1.2, 5.5);
    c.ellipse(random.uniform(0, n), random.uniform(0, n), a, a * random.uniform(0.5, 1), random.uniform(0, 3),
              float(random.uniform(60, 185)), 0.85f);
  }
  c.noise(random, 2, 4, 22);
  return c;
}

// Planks with grain along x.
Canvas wood(Random& random) {
  const int n = 1024;
  Canvas c(n, n, 150);
  const int planks = 8;
  const double h = double(n) / planks;
  for (int p = 0; p < planks; ++p) {
    const float tone = float(random.uniform(110, 165));
    c.rect(0, p * h, n, (p + 1) * h, tone);
    for (int i = 0; i < 60; ++i) {
      const double y = p * h + random.uniform(3, h - 3), x = random.uniform(0, n),
                   bend = random.uniform(-6, 6);
      const double length = random.uniform(60, 500);
      for (int k = 0; k < 6; ++k)
        c.line(x + length * k / 6, y + bend * std::sin(k * 0.5), x + length * (k + 1) / 6,
               y + bend * std::sin((k + 1) * 0.5), random.uniform(0.8, 2),
               tone - float(random.uniform(10, 45)), 0.5f);
    }
    for (int i = 0, knots = random.below(3); i < knots; ++i) {
      const double x = random.uniform(0, n), y = p * h + random.uniform(15, h - 15);
      for (double r = 16; r > 2; r -= 3) c.ellipse(x, y, r * 1.6, r, 0, tone - 70 + float(r) * 3, 0.7f);
    }
    c.rect(0, (p + 1) * h - 2, n, (p + 1) * h, 45, 0.9f);
  }
  c.noise(random, 4, 7, 14, 0.7f);
  c.grain(random, 4);
  return c;
}

Canvas carpet(Random& random) {
  const int n = 512;
  Canvas c(n, n, 95);
  c.noise(random, 4, 7, 26, 0.8f);
  for (int y = 0; y < n; y += 64)
    for (int x = 0; x < n; x += 64) {
      c.ellipse(x + 32, y + 32, 20, 20, 0, 70, 0.6f), c.ellipse(x + 32, y + 32, 11, 11, 0, 135, 0.7f);
      c.line(x, y, x + 12, y + 12, 3, 140, 0.7f);
    }
  c.grain(random, 14);
  return c;
}

Canvas floor_tiles(Random& random) {
  const int n = 512;
  Canvas c(n, n, 70);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      c.rect(x * 64 + 1, y * 64 + 1, x * 64 + 63, y * 64 + 63, 140 + float(random.uniform(-22, 22)));
  c.noise(random, 3, 8, 22, 0.75f);
  for (int i = 0; i < 300; ++i)
    c.ellipse(random.uniform(0, n), random.uniform(0, n), random.uniform(0.7, 2.5), random.uniform(0.7, 2.5),
              0, float(random.uniform(60, 200)), 0.6f);
  c.grain(random, 4);
  return c;
}

Canvas water(Random& random) {
  const int n = 512;
  Canvas c(n, n, 120);
  for (int i = 0; i < 2600; ++i) {
    const double x = random.uniform(0, n), y = random.uniform(0, n), w = random.uniform(6, 40);
    c.ellipse(x, y, w, random.uniform(1, 3.5), random.uniform(-0.15, 0.15), float(random.uniform(85, 165)),
              0.35f);
  }
  c.noise(random, 4, 5, 14);
  return c;
}

Canvas paint(Random& random) {  // road marks, worn
  Canvas c(64, 256, 215);
  c.noise(random, 4, 5, 45, 0.8f);
  c.grain(random, 12);
  return c;
}

// Lines along x only: it has no cue for motion along them.
Canvas stripes(Random& random) {
  const int n = 256;
  const float tone = float(random.uniform(120, 175));
  Canvas c(n, n, tone);
  for (double y = 0; y < n; y += random.uniform(14, 44))
    c.rect(0, y, n, y + random.uniform(2, 9), tone + float(random.uniform(-45, 25)));
  c.grain(random, 2);
  return c;
}

Canvas manhole(Random& random) {
  Canvas c(128, 128, 90);
  c.cut_out();
  c.ellipse(64, 64, 60, 60, 0, 55), c.ellipse(64, 64, 54, 54, 0, 105);
  for (int i = -4; i <= 4; ++i) {
    const double half = std::sqrt(std::max(0.0, 48.0 * 48 - 121.0 * i * i));
    c.line(64 + 11 * i, 64 - half, 64 + 11 * i, 64 + half, 3, 60);
    c.line(64 - half, 64 + 11 * i, 64 + half, 64 + 11 * i, 3, 60);
  }
  c.noise(random, 4, 5, 15);
  return c;
}

}  // namespace

std::vector<TextureKind> ground_textures() {
  return {{"asphalt", 8, 8, asphalt, Thing::kGround},
          {"slabs", 4, 4, slabs, Thing::kGround},
          {"grass", 4, 4, grass, Thing::kGround},
          {"gravel", 4, 4, gravel, Thing::kGround},
          {"wood", 1.6, 1.6, wood},
          {"carpet", 2, 2, carpet, Thing::kGround},
          {"floor_tiles", 3.2, 3.2, floor_tiles, Thing::kGround},
          {"water", 12, 12, water, Thing::kGround},
          {"paint", 0.15, 3, paint, Thing::kMarking},
          {"stripes", 2, 1.4, stripes, Thing::kBuilding},
          {"manhole", 0.7, 0.7, manhole, Thing::kMarking}};
}

}  // namespace edgevo
