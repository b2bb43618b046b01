// SPDX-License-Identifier: BSD-3-Clause
// Fronts on a wall: windows, doors, shops, signs. One repeat fills the surface.
#include <cmath>

#include "texture_kinds.h"

namespace edgevo {
namespace {

// A pane: dark, with the sky mirrored in its upper part and something behind it.
void pane(Canvas* c, Random& random, double x0, double y0, double x1, double y1) {
  const float dark = float(random.uniform(22, 60)), sky = float(random.uniform(60, 175));
  const double horizon = y0 + (y1 - y0) * random.uniform(0.15, 0.7);
  c->rect(x0, y0, x1, y1, dark);
  for (int i = 0; i < 12; ++i) {  // an uneven skyline
    const double a = x0 + (x1 - x0) * i / 12, top = horizon + random.uniform(-0.12, 0.12) * (y1 - y0);
    c->rect(a, y0, a + (x1 - x0) / 12, top, sky, 0.6f);
  }
  if (random.uniform() < 0.5) {  // curtains
    const double w = (x1 - x0) * random.uniform(0.12, 0.3);
    const float cloth = float(random.uniform(110, 200));
    for (double x = 0; x < w; x += 3) {
      const float fold = cloth + float(random.uniform(-30, 20));
      c->rect(x0 + x, y0, x0 + x + 3, y1, fold, 0.75f);
      c->rect(x1 - x - 3, y0, x1 - x, y1, fold, 0.75f);
    }
  }
}

Canvas window(Random& random) {
  const int w = 128, h = 256;
  Canvas c(w, h, float(random.uniform(150, 225)));
  const int columns = 1 + random.below(3), rows = 1 + random.below(3);
  const double frame = 9, bar = 5;
  const float shade = c.at(0, 0) - 70;
  c.rect(0, 0, w, 2, shade), c.rect(0, h - 3, w, h, shade), c.rect(0, 0, 2, h, shade),
      c.rect(w - 2, 0, w, h, shade);
  const double pw = (w - 2 * frame - (columns - 1) * bar) / columns,
               ph = (h - 2 * frame - (rows - 1) * bar) / rows;
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      const double x = frame + i * (pw + bar), y = frame + k * (ph + bar);
      pane(&c, random, x, y, x + pw, y + ph);
      c.rect(x, y, x + pw, y + 2.5, 30, 0.6f);
    }
  if (random.uniform() < 0.3)  // a blind, partly down
    for (double y = frame, end = h * random.uniform(0.2, 0.7); y < end; y += 6)
      c.rect(frame, y, w - frame, y + 4.5, 165 + float(random.uniform(-8, 8)));
  c.noise(random, 4, 5, 8);
  return c;
}

Canvas door(Random& random) {
  const int w = 128, h = 256;
  const float tone = float(random.uniform(45, 150));
  Canvas c(w, h, float(random.uniform(130, 200)));
  c.rect(9, 8, w - 9, h, tone);
  const int rows = 2 + random.below(3);
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < 2; ++i) {
      const double y0 = 20 + k * (h - 30.0) / rows, y1 = y0 + (h - 30.0) / rows - 12, x0 = 18 + i * 48.0;
      if (k == 0)
        pane(&c, random, x0, y0, x0 + 42, y1);
      else
        c.panel(x0, y0, x0 + 42, y1, tone + 8, 2.5, 24);
    }
  c.ellipse(w - 20, h * 0.55, 4, 4, 0, 215);
  c.rect(40, h * 0.58, 88, h * 0.6, 30);
  c.noise(random, 4, 6, 14, 0.7f);
  return c;
}

Canvas shop(Random& random) {
  const int w = 512, h = 256;
  Canvas c(w, h, float(random.uniform(60, 150)));
  const float board = float(random.uniform(25, 215)), ink = board > 120 ? 25.0f : 230.0f;
  c.panel(6, 4, w - 6, 62, board, 3, 20);
  write_text(&c, random, 40, 14, w - 40, 56, 38, ink);
  for (int i = 0; i < 3; ++i) {
    const double x0 = 14 + i * 166.0, x1 = x0 + 152;
    pane(&c, random, x0, 76, x1, 244);
    for (int k = 0; k < 9; ++k) {  // goods on display
      const double x = random.uniform(x0 + 6, x1 - 26), y = random.uniform(150, 215);
      c.panel(x, y, x + random.uniform(8, 24), 238, float(random.uniform(60, 220)), 1.5, 20);
    }
    write_text(&c, random, x0 + 20, 90, x1 - 20, 125, 13, 220);
    c.rect(x0, 76, x0 + 3, 244, 190), c.rect(x1 - 3, 76, x1, 244, 190), c.rect(x0, 241, x1, 244, 190);
  }
  c.noise(random, 8, 6, 10);
  return c;
}

Canvas garage(Random& random) {
  const int w = 256, h = 256;
  const float tone = float(random.uniform(90, 190));
  Canvas c(w, h, tone);
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 4; ++i)
      c.panel(i * 64 + 5, k * 32 + 3, i * 64 + 59, k * 32 + 29, tone + float(random.uniform(-6, 6)), 2, 24);
  c.rect(0, 0, 5, h, tone - 60), c.rect(w - 5, 0, w, h, tone - 60), c.rect(0, 0, w, 4, tone - 70);
  c.noise(random, 4, 7, 18, 0.7f);
  return c;
}

Canvas sign(Random& random) {
  const int w = 128, h = 128;
  Canvas c(w, h, 230);
  c.cut_out();
  const bool round = random.uniform() < 0.5;
  if (round) {
    c.ellipse(64, 64, 60, 60, 0, 80), c.ellipse(64, 64, 46, 46, 0, 235);
    write_text(&c, random, 34, 46, 96, 92, 36, 25);
  } else {
    c.rect(6, 20, 122, 108, 60), c.rect(11, 25, 117, 103, 225);
    write_text(&c, random, 18, 32, 110, 100, 20, 30);
  }
  return c;
}

Canvas poster(Random& random) {
  const int w = 256, h = 512;
  Canvas c(w, h, float(random.uniform(120, 225)));
  c.noise(random, 2, 6, 60);
  for (int i = 0; i < 14; ++i)
    c.ellipse(random.uniform(20, w - 20), random.uniform(40, 330), random.uniform(8, 55),
              random.uniform(8, 70), random.uniform(0, 3), float(random.uniform(20, 240)), 0.8f);
  for (int i = 0; i < 8; ++i)
    c.line(random.uniform(0, w), random.uniform(0, 340), random.uniform(0, w), random.uniform(0, 340),
           random.uniform(2, 9), float(random.uniform(10, 250)), 0.8f);
  c.rect(0, 350, w, h, float(random.uniform(190, 240)));
  write_text(&c, random, 16, 362, w - 16, 400, 30, 20);
  write_text(&c, random, 16, 420, w - 16, 505, 11, 40);
  c.rect(0, 0, w, 4, 30), c.rect(0, h - 4, w, h, 30), c.rect(0, 0, 4, h, 30), c.rect(w - 4, 0, w, h, 30);
  return c;
}

}  // namespace

std::vector<TextureKind> front_textures() {
  return {{"window", 1.1, 1.7, window, Thing::kBuilding},
          {"door", 1.1, 2.3, door, Thing::kBuilding},
          {"shop", 5.5, 2.8, shop, Thing::kBuilding},
          {"garage", 2.6, 2.4, garage, Thing::kBuilding},
          {"sign", 0.7, 0.7, sign},
          {"poster", 0.7, 1.4, poster}};
}

}  // namespace edgevo
