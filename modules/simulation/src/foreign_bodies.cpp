// SPDX-License-Identifier: BSD-3-Clause
#include "foreign_bodies.h"

#include <cmath>

#include "texture_kinds.h"

namespace edgevo {

Canvas textured_part(Random& random) {
  Canvas c(512, 256, 95);
  c.noise(random, 3, 4, 12);
  for (int i = 0; i < 22; ++i) {
    const double x = random.uniform(10, 440), y = random.uniform(10, 210);
    const double w = random.uniform(20, 90), h = random.uniform(15, 60);
    c.panel(x, y, x + w, y + h, float(random.uniform(30, 200)), 3, 30);
  }
  for (int i = 0; i < 12; ++i) {
    const double x = random.uniform(20, 490), y = random.uniform(20, 236);
    c.ellipse(x, y, 8, 8, 0, float(random.uniform(20, 60)));
    c.ellipse(x, y, 4, 4, 0, 180);
  }
  write_text(&c, random, 60, 100, 300, 150, 12, 225);
  return c;
}

Canvas plain_part(Random&) { return Canvas(512, 256, 70); }

Canvas dashboard(Random& random) {
  Canvas c(1024, 256, 52);
  c.noise(random, 2, 3, 4);
  for (const double x : {250.0, 420.0}) {
    c.ellipse(x, 140, 66, 66, 0, 25);
    c.ellipse(x, 140, 60, 60, 0, 38);
    for (int k = 0; k < 24; ++k) {
      const double a = 2.4 + k * 0.196, s = std::sin(a), o = std::cos(a);
      c.line(x + 46 * o, 140 + 46 * s, x + 56 * o, 140 + 56 * s, 2.5, 210);
    }
    c.line(x, 140, x + 40, 140 - 25, 3.5, 230);
  }
  c.panel(540, 90, 720, 200, 30, 3, 25);
  write_text(&c, random, 555, 105, 705, 190, 14, 150);
  for (double y = 100; y < 190; y += 14) c.line(780, y, 900, y, 4, 20);
  for (const double x : {60.0, 120.0, 940.0, 985.0}) c.panel(x, 130, x + 36, 160, 90, 3, 40);
  c.line(0, 75, 1024, 75, 3, 90);
  c.cut_where([](double x, double y) { return y < 6 + 40 * (x - 512) * (x - 512) / (512.0 * 512.0); });
  return c;
}

Canvas lorry_rear(Random& random) {
  Canvas c(512, 512, float(random.uniform(140, 200)));
  c.noise(random, 2, 4, 6);
  c.rect(0, 0, 512, 8, 60), c.rect(0, 0, 8, 512, 60), c.rect(504, 0, 512, 512, 60);
  c.line(256, 0, 256, 400, 4, 50);
  for (const double x : {90.0, 215.0, 300.0, 425.0}) c.line(x, 15, x, 395, 7, 105);
  for (const double y : {60.0, 200.0, 340.0})
    for (const double x : {20.0, 470.0}) c.panel(x, y, x + 26, y + 16, 80, 3, 40);
  write_text(&c, random, 110, 100, 410, 180, 26, 60);
  c.rect(0, 400, 512, 408, 30);
  c.panel(0, 420, 512, 450, 60, 4, 30);
  for (const double x : {20.0, 402.0}) {
    c.panel(x, 424, x + 45, 446, 190, 3, 30);
    c.panel(x + 48, 424, x + 90, 446, 110, 3, 30);
  }
  c.panel(200, 424, 312, 446, 235, 2, -60);
  c.rect(0, 460, 512, 512, 25);
  c.rect(50, 455, 130, 512, 15), c.rect(382, 455, 462, 512, 15);
  return c;
}

Canvas bus_side(Random& random) {
  Canvas c(1024, 256, float(random.uniform(120, 210)));
  c.noise(random, 2, 4, 6);
  c.rect(0, 0, 1024, 6, 50), c.rect(0, 0, 6, 256, 50), c.rect(1018, 0, 1024, 256, 50);
  for (int k = 0; k < 9; ++k) c.panel(20 + k * 110, 30, 115 + k * 110, 105, 45, 4, -30);
  for (const double x : {130.0, 570.0}) c.panel(x, 25, x + 95, 225, 65, 4, 35);
  c.rect(0, 125, 1024, 134, 60);
  write_text(&c, random, 260, 145, 540, 200, 18, 40);
  c.panel(700, 142, 960, 200, 230, 3, -60);
  write_text(&c, random, 712, 150, 948, 195, 14, 70);
  c.rect(0, 225, 1024, 240, 35);
  for (const double x : {70.0, 500.0, 880.0}) {
    c.ellipse(x, 224, 31, 31, 0, 20);
    c.ellipse(x, 224, 18, 18, 0, 150);
  }
  c.cut_where([](double x, double y) {
    if (y < 240) return false;
    for (const double wheel : {70.0, 500.0, 880.0})
      if (std::hypot(x - wheel, y - 224) < 31) return false;
    return true;
  });
  return c;
}

Canvas bonnet(Random& random) {
  Canvas c(1024, 256, 62);
  c.noise(random, 2, 3, 3);
  for (const double x : {230.0, 794.0}) c.line(512 + 0.55 * (x - 512), 40, x, 256, 4, 44);
  c.line(380, 225, 640, 225, 5, 30);
  for (const double x : {400.0, 624.0}) c.ellipse(x, 235, 9, 5, 0, 25);
  c.cut_where([](double x, double y) { return y < 4 + 70 * std::pow((x - 512) / 512, 2); });
  return c;
}

Canvas bow(Random& random) {
  Canvas c(1024, 256, 185);
  c.noise(random, 3, 4, 8);
  for (int k = -8; k <= 8; ++k) c.line(512 + 8.0 * k, 0, 512 + 60.0 * k, 256, 2.5, 120);
  for (const double y : {150.0, 200.0})
    for (const double x : {440.0, 584.0}) c.panel(x - 20, y, x + 20, y + 18, 90, 3, 40);
  c.ellipse(512, 95, 16, 10, 0, 45);
  c.cut_where([](double x, double y) { return std::abs(x - 512) > 12 + 1.9 * y; });
  return c;
}

Canvas person(Random& random) {
  Canvas c(128, 256, 90);
  const float coat = float(random.uniform(30, 220)), legs = float(random.uniform(25, 110));
  c.cut_out();
  c.line(52, 150, 46, 238, 20, legs), c.line(76, 150, 84, 238, 20, legs);
  c.rect(38, 246, 60, 256, 20), c.rect(74, 246, 98, 256, 20);
  c.ellipse(64, 90, 30, 52, 0, coat);
  c.rect(38, 60, 90, 150, coat);
  c.line(36, 66, 26, 140, 15, 0.8f * coat), c.line(92, 66, 102, 140, 15, 0.8f * coat);
  c.line(64, 52, 64, 148, 2.5, coat > 120 ? 50.0f : 200.0f);
  c.rect(40, 118, 88, 123, coat > 120 ? 60.0f : 190.0f);
  c.panel(72, 72, 84, 84, 200, 2, -50);
  c.ellipse(64, 24, 16, 22, 0, 165), c.ellipse(64, 12, 17, 12, 0, 40);
  return c;
}

std::vector<TextureKind> body_textures() {
  return {{"lorry_rear", 2.5, 2.6, lorry_rear}, {"bus_side", 12, 3, bus_side}, {"person", 0.6, 1.75, person}};
}

}  // namespace edgevo
