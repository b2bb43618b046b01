// SPDX-License-Identifier: BSD-3-Clause
// Cars, and objects on a desk or on the walls of a corridor.
#include <cmath>

#include "texture_kinds.h"

namespace edgevo {
namespace {

// Seen from its left side, front to the left. Outline as in props.cpp: bonnet, windscreen, roof, boot.
Canvas car_side(Random& random) {
  const int w = 512, h = 256;
  const float paint = float(random.uniform(40, 215));
  Canvas c(w, h, paint);
  c.noise(random, 2, 5, 10);
  c.fade(1.12f, 0.8f);
  const double belt = 100;  // lower rim of the windows
  c.line(166, belt, 214, 16, 3, 20), c.line(214, 16, 372, 16, 3, 20);
  for (int i = 0; i < 2; ++i) {
    const double x0 = i == 0 ? 182 : 300, x1 = i == 0 ? 292 : 415;
    const double t0 = i == 0 ? 226 : 300, t1 = i == 0 ? 292 : 372;
    for (double y = 24; y < belt - 6; y += 1) {
      const double s = (y - 24) / (belt - 30);
      const float glass = float(140 - 95 * s);
      c.rect(t0 + (x0 - t0) * s, y, t1 + (x1 - t1) * s, y + 1, glass);
    }
  }
  c.rect(8, belt, w - 8, belt + 3, 0.55f * paint);
  for (double x : {176.0, 296.0, 408.0}) c.rect(x, belt, x + 2.5, 205, 0.4f * paint);
  for (double x : {270.0, 385.0}) c.rect(x, 115, x + 18, 120, 0.5f * paint + 90);
  c.rect(6, 165, w - 6, 170, 0.6f * paint);
  c.rect(0, 206, w, 222, 35);
  c.rect(8, 118, 34, 140, 235), c.rect(w - 26, 110, w - 6, 142, 70);
  for (double x : {105.0, 400.0}) {
    c.ellipse(x, 205, 47, 47, 0, 22), c.ellipse(x, 210, 42, 42, 0, 38), c.ellipse(x, 210, 27, 27, 0, 165);
    for (int k = 0; k < 5; ++k)
      c.line(x, 210, x + 24 * std::cos(k * 1.2566), 210 + 24 * std::sin(k * 1.2566), 6, 70);
    c.ellipse(x, 210, 6, 6, 0, 190);
  }
  c.cut_where([](double x, double y) {
    if (y > 222) return std::hypot(x - 105, y - 210) > 42 && std::hypot(x - 400, y - 210) > 42;
    if (x < 160) return y < 118 - 18 * x / 160;
    if (x < 212) return y < 100 - 90 * (x - 160) / 52;
    if (x < 375) return y < 10;
    if (x < 440) return y < 10 + 82 * (x - 375) / 65;
    return y < 92 + 6 * (x - 440) / 72;
  });
  return c;
}

Canvas car_end(Random& random) {
  const int w = 256, h = 128;
  const float paint = float(random.uniform(40, 215));
  Canvas c(w, h, paint);
  c.fade(1.1f, 0.8f);
  c.panel(8, 18, 58, 48, 225, 3, 20), c.panel(w - 58, 18, w - 8, 48, 225, 3, 20);
  c.rect(70, 20, w - 70, 46, 30);
  for (double y = 24; y < 46; y += 6) c.rect(72, y, w - 72, y + 2, 120);
  c.rect(0, 70, w, 74, 0.5f * paint);
  c.panel(88, 80, 168, 100, 232, 2, -60);
  write_text(&c, random, 96, 83, 162, 100, 13, 20);
  c.rect(0, 108, w, h, 30);
  return c;
}

Canvas car_glass(Random& random) {
  Canvas c(128, 128, 60);
  c.fade(1.9f, 0.6f);
  c.ellipse(40, 90, 18, 30, 0, 35, 0.8f), c.ellipse(92, 90, 18, 30, 0, 35, 0.8f);
  c.line(10, 120, 60, 108, 2.5, 15), c.line(64, 122, 112, 110, 2.5, 15);
  c.rect(0, 0, 128, 4, 20), c.rect(0, 124, 128, 128, 20), c.rect(0, 0, 4, 128, 20),
      c.rect(124, 0, 128, 128, 20);
  c.noise(random, 2, 4, 10);
  return c;
}

Canvas metal(Random& random) {
  Canvas c(128, 128, float(random.uniform(80, 190)));
  c.noise(random, 2, 6, 22, 0.7f);
  c.grain(random, 4);
  return c;
}

Canvas paper(Random& random) {
  Canvas c(256, 256, 228);
  c.noise(random, 2, 4, 8);
  write_text(&c, random, 22, 18, 234, 44, 17, 35);
  write_text(&c, random, 22, 56, 234, random.uniform() < 0.5 ? 242 : 150, 7, 55);
  if (random.uniform() < 0.6) {
    c.panel(40, 165, 215, 238, 190, 2, -80);
    for (int i = 0; i < 9; ++i)
      c.line(45 + 18.0 * i, random.uniform(175, 232), 63 + 18.0 * i, random.uniform(175, 232), 2, 50);
  }
  return c;
}

Canvas screen(Random& random) {
  const int w = 512, h = 256;
  Canvas c(w, h, 25);
  c.rect(10, 8, w - 10, h - 14, float(random.uniform(45, 215)));
  for (int i = 0; i < 3; ++i) {
    const double x = random.uniform(14, 230), y = random.uniform(12, 90), x1 = x + random.uniform(150, 260),
                 y1 = y + random.uniform(80, 140);
    const float tone = float(random.uniform(30, 240));
    c.rect(x, y, x1, y1, tone), c.rect(x, y, x1, y + 9, 0.6f * tone + 60);
    write_text(&c, random, x + 5, y + 13, x1 - 5, y1 - 2, 7, tone > 120 ? 30.0f : 215.0f);
  }
  return c;
}

Canvas keyboard(Random& random) {
  const int w = 512, h = 256;
  const float base = float(random.uniform(35, 70)), key = random.uniform() < 0.5 ? base + 35 : 200;
  Canvas c(w, h, base);
  for (int r = 0; r < 5; ++r)
    for (double x = 12; x < w - 40;) {
      const double wide = (r == 4 && x > 120 && x < 260) ? 150 : 28 * random.uniform(0.95, 1.3);
      c.panel(x, 16 + r * 46.0, x + wide - 4, 56 + r * 46.0, key, 3, 22);
      c.rect(x + 7, 24 + r * 46.0, x + 14, 34 + r * 46.0, key > 120 ? 40.0f : 220.0f);
      x += wide;
    }
  return c;
}

Canvas book(Random& random) {
  Canvas c(128, 256, float(random.uniform(35, 210)));
  const float ink = c.at(0, 0) > 120 ? 25.0f : 225.0f;
  c.noise(random, 2, 5, 12);
  c.rect(8, 10, 120, 14, ink), c.rect(8, 240, 120, 244, ink);
  write_text(&c, random, 14, 26, 116, 90, 22, ink);
  for (int i = 0; i < 6; ++i)
    c.ellipse(random.uniform(25, 105), random.uniform(110, 215), random.uniform(5, 26), random.uniform(5, 26),
              0, float(random.uniform(20, 240)), 0.8f);
  return c;
}

Canvas box(Random& random) {
  Canvas c(256, 256, float(random.uniform(110, 190)));
  c.noise(random, 2, 6, 14, 0.7f);
  c.rect(0, 118, 256, 138, 215, 0.6f);
  write_text(&c, random, 30, 30, 220, 104, 30, 45);
  c.panel(150, 160, 238, 236, 225, 2, -70);
  write_text(&c, random, 156, 166, 232, 232, 8, 30);
  c.rect(0, 0, 256, 3, 60), c.rect(0, 253, 256, 256, 60), c.rect(0, 0, 3, 256, 60),
      c.rect(253, 0, 256, 256, 60);
  return c;
}

Canvas mug(Random& random) {
  Canvas c(256, 128, float(random.uniform(130, 230)));
  const float ink = float(random.uniform(20, 90));
  for (int i = 0; i < 8; ++i) c.ellipse(16 + 32.0 * i, 64, 10, 24, 0, ink, 0.9f);
  c.rect(0, 14, 256, 22, ink), c.rect(0, 106, 256, 114, ink);
  return c;
}

Canvas shelf(Random& random) {
  const int w = 512, h = 512;
  Canvas c(w, h, 55);
  for (int r = 0; r < 4; ++r) {
    const double floor = 122 + r * 128.0;
    for (double x = 10; x < w - 20;) {
      const double wide = random.uniform(8, 30), tall = random.uniform(65, 108);
      const float tone = float(random.uniform(30, 225)), ink = tone > 120 ? 30.0f : 220.0f;
      if (random.uniform() < 0.9) {
        c.panel(x, floor - tall, x + wide, floor, tone, 1.2, 22);
        if (wide > 12) c.rect(x + 3, floor - tall * 0.8, x + wide - 3, floor - tall * 0.7, ink);
        for (int k = 0; k < 4; ++k)
          c.rect(x + wide * 0.35, floor - tall * (0.55 - 0.1 * k), x + wide * 0.65,
                 floor - tall * (0.5 - 0.1 * k), ink, 0.8f);
      }
      x += wide + 1;
    }
    c.rect(0, floor, w, floor + 9, 165);
  }
  c.rect(0, 0, 8, h, 165), c.rect(w - 8, 0, w, h, 165);
  return c;
}

}  // namespace

std::vector<TextureKind> object_textures() {
  return {{"car_side", 4.3, 1.5, car_side},
          {"car_end", 1.7, 0.75, car_end},
          {"car_glass", 1.4, 0.8, car_glass},
          {"metal", 1, 1, metal},
          {"paper", 0.21, 0.297, paper},
          {"screen", 0.52, 0.32, screen},
          {"keyboard", 0.45, 0.16, keyboard},
          {"book", 0.17, 0.24, book},
          {"box", 0.4, 0.4, box},
          {"mug", 0.25, 0.1, mug},
          {"shelf", 2, 2, shelf}};
}

}  // namespace edgevo
