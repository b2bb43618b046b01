// SPDX-License-Identifier: BSD-3-Clause
// Trees, bushes, reeds, boulders and clouds.
#include <algorithm>
#include <cmath>

#include "texture_kinds.h"

namespace edgevo {
namespace {

Canvas bark(Random& random) {
  Canvas c(128, 256, float(random.uniform(60, 105)));
  for (int i = 0; i < 260; ++i) {
    const double x = random.uniform(0, 128), y = random.uniform(0, 256), length = random.uniform(15, 60);
    c.line(x, y, x + random.uniform(-6, 6), y + length, random.uniform(1, 3.5),
           float(random.uniform(40, 125)), 0.36f);
  }
  c.noise(random, 4, 5, 20);
  return c;
}

// Leaves in clusters inside an outline; those drawn last are the brightest, as the sun comes from above.
void leaves(Canvas* c, Random& random, int clusters, int per_cluster, double spread, double leaf,
            const std::function<bool(double, double)>& inside) {
  for (int k = 0; k < clusters; ++k) {
    const double x = random.uniform(0, c->width()), y = random.uniform(0, c->height());
    if (!inside(x / c->width(), y / c->height())) continue;
    const double light =
        random.uniform(0.65, 1.1) * (1.15 - 0.5 * y / c->height()) * (0.55 + 0.45 * k / clusters);
    for (int i = 0; i < per_cluster; ++i) {
      const double size = leaf * random.uniform(0.6, 1.3);
      const double px = x + spread * random.normal(), py = y + 0.8 * spread * random.normal();
      if (px < 6 || py < 6 || px > c->width() - 6 || py > c->height() - 6) continue;  // must not wrap around
      const float tone = float(light * (70 + 30 * i / per_cluster) + random.uniform(-6, 6));
      c->ellipse(px, py, size, size * random.uniform(0.35, 0.65), random.uniform(0, 3.1416), tone);
    }
  }
}

void branch(Canvas* c, Random& random, double x, double y, double heading, double length, double width) {
  if (length < 12) return;
  const double nx = x + length * std::cos(heading), ny = y + length * std::sin(heading);
  c->line(x, y, nx, ny, width, float(random.uniform(35, 70)));
  for (int i = 0; i < 2; ++i)
    branch(c, random, nx, ny, heading + random.uniform(-0.75, 0.75), length * random.uniform(0.65, 0.85),
           width * 0.65);
}

// `clusters` of leaves: 460 of a tree in full leaf.
Canvas crown_of(Random& random, int clusters) {
  const int n = 512;
  Canvas c(n, n, 60);
  c.cut_out();
  branch(&c, random, n / 2.0, 0.82 * n, -1.5708, 80, 11);  // from inside the leaves on: the trunk is a prism
  const double phase = random.uniform(0, 6.283), bumps = 3 + random.below(3);
  leaves(&c, random, clusters, 30, 17, 5.5, [&](double x, double y) {
    const double dx = (x - 0.5) / 0.42, dy = (y - 0.46) / 0.40, a = std::atan2(dy, dx);
    return dx * dx + dy * dy < 0.85 + 0.22 * std::sin(bumps * a + phase);
  });
  return c;
}

Canvas crown(Random& random) { return crown_of(random, 460); }
Canvas crown_thin(Random& random) { return crown_of(random, 150); }

// Twigs from the trunk up and outwards, none with a leaf.
Canvas crown_bare(Random& random) {
  const int n = 512;
  Canvas c(n, n, 60);
  c.cut_out();
  for (int i = 0; i < 9; ++i)
    branch(&c, random, n / 2.0 + random.uniform(-8, 8), random.uniform(0.6, 0.92) * n,
           -1.5708 + random.uniform(-0.9, 0.9), random.uniform(60, 95), random.uniform(5, 11));
  return c;
}

// A branch of needles: short strokes below a line that droops outwards.
void needle_branch(Canvas* c, Random& random, double y, double side, double reach) {
  const double x0 = c->width() / 2.0, droop = random.uniform(0.15, 0.5);
  const float tone = float(random.uniform(28, 85));
  c->line(x0, y, x0 + side * reach, y + droop * reach, random.uniform(2, 4), tone);
  for (double t = 0.1; t < 1; t += 4 / reach) {
    const double x = x0 + side * reach * t, top = y + droop * reach * t,
                 length = random.uniform(4, 11) * (1.2 - 0.6 * t);
    const float light = tone + float(random.uniform(-10, 60)) * float(t);
    c->line(x, top - 2, x + side * random.uniform(0, 5), top + length, 2.2, light);
    if (random.uniform() < 0.5)
      c->line(x, top, x + side * random.uniform(1, 6), top - 0.5 * length, 2, light + 18);
  }
}

Canvas conifer(Random& random) {
  const int w = 256, h = 512;
  Canvas c(w, h, 50);
  c.cut_out();
  c.line(w / 2.0, h - 5, w / 2.0, 14, 7, 45);
  for (double y = 14; y < h - 70; y += random.uniform(4, 9))
    for (double side : {-1.0, 1.0}) {
      const double reach = (0.05 + 0.95 * y / h) * 0.45 * w * random.uniform(0.45, 1.0);
      needle_branch(&c, random, y + random.uniform(-5, 5), side, std::max(6.0, reach));
    }
  return c;
}

Canvas bush_of(Random& random, int clusters) {
  const int w = 512, h = 256;
  Canvas c(w, h, 55);
  c.cut_out();
  const double phase = random.uniform(0, 6.283);
  leaves(&c, random, clusters, 26, 11, 4.5, [&](double x, double y) {
    const double outline = 0.35 + 0.12 * std::sin(9 * x + phase) + 0.06 * std::sin(23 * x + 2 * phase);
    return x > 0.06 && x < 0.94 && y > outline + 1.4 * std::pow(std::abs(x - 0.5), 2);
  });
  for (int i = 0; i < 60; ++i) {  // shade at its foot
    const double off = random.uniform(-1, 1);
    c.ellipse(w * (0.5 + 0.42 * off), h - 8 - 14 * (1 - off * off) * random.uniform(), random.uniform(8, 16),
              random.uniform(5, 9), 0, 42);
  }
  return c;
}

Canvas bush(Random& random) { return bush_of(random, 420); }
Canvas bush_thin(Random& random) { return bush_of(random, 150); }

// Rods from the ground up.
Canvas bush_bare(Random& random) {
  const int w = 512, h = 256;
  Canvas c(w, h, 55);
  c.cut_out();
  for (int i = 0; i < 34; ++i)
    branch(&c, random, w * random.uniform(0.15, 0.85), h - 4, -1.5708 + random.uniform(-0.5, 0.5),
           random.uniform(35, 60), random.uniform(2.5, 4.5));
  return c;
}

// A wood from a distance: overlapping crowns and tips, as dark as trees against the sky. `clusters` of leaves
// on each crown that sheds them: 700 in summer.
Canvas forest_of(Random& random, int clusters) {
  const int w = 512, h = 256;
  Canvas c(w, h, 55);
  c.cut_out();
  for (int i = 0; i < 22; ++i) {
    const double cx = random.uniform(50, w - 50), top = random.uniform(14, 130),
                 half = random.uniform(22, 46);
    const bool is_conifer = random.uniform() < 0.4;
    leaves(&c, random, is_conifer ? 700 : clusters, 14, 6, 3.4, [&](double x, double y) {
      const double dx = (x * w - cx) / half, dy = y * h - top;
      if (dy < 0) return false;
      return is_conifer ? std::abs(dx) < 0.75 * dy / (h - top)
                        : dx * dx < 1 - std::pow(std::max(0.0, 1 - dy / half), 2);
    });
  }
  return c;
}

Canvas forest(Random& random) { return forest_of(random, 700); }
Canvas forest_thin(Random& random) { return forest_of(random, 220); }

// Conifers among bare twigs.
Canvas forest_bare(Random& random) {
  Canvas c = forest_of(random, 0);
  for (int i = 0; i < 60; ++i)
    branch(&c, random, random.uniform(30, 482), 250, -1.5708 + random.uniform(-0.3, 0.3),
           random.uniform(45, 62), random.uniform(3, 5));
  return c;
}

// A clump: blades lean outwards, the outer ones are shorter, those behind are darker.
Canvas reeds(Random& random) {
  const int w = 512, h = 256, blades = 430;
  Canvas c(w, h, 90);
  c.cut_out();
  for (int i = 0; i < blades; ++i) {
    const double off = std::clamp(0.4 * random.normal(), -1.0, 1.0), x = w * (0.5 + 0.4 * off);
    const double top = 16 + 120 * off * off + random.uniform(0, 80),
                 lean = 26 * off + random.uniform(-10, 10);
    const float tone = float(random.uniform(50, 85) + 55.0 * i / blades);
    const double knee = h - 0.6 * (h - top);
    c.line(x, h - 3, x + 0.35 * lean, knee, random.uniform(2, 3.2), 0.75f * tone);
    c.line(x + 0.35 * lean, knee, x + lean, top, random.uniform(1.2, 2), tone);
    if (random.uniform() < 0.1) c.ellipse(x + lean, top + 8, 3, 9, 0, 50);
  }
  return c;
}

// A boulder from the side: light from above, wet and dark at the foot.
Canvas boulder(Random& random) {
  const int w = 256, h = 128;
  Canvas c(w, h, 100);
  c.cut_out();
  const double tilt = random.uniform(-0.25, 0.25), tone = random.uniform(0.85, 1.15);
  c.ellipse(w / 2.0, h - 32, 104, 27, 0, float(60 * tone));
  for (int i = 0; i < 70; ++i) {
    const double a = random.uniform(0, 3.1416), r = std::sqrt(random.uniform());
    const double x = w / 2.0 + 80 * r * std::cos(a),
                 y = h - 30 - 60 * r * std::sin(a) * (1 + tilt * std::cos(a));
    const float light = float(tone * (150 - 85 * y / h + random.uniform(-14, 14)));
    c.ellipse(x, y, random.uniform(10, 22), random.uniform(6, 14), random.uniform(-0.6, 0.6) + tilt, light,
              0.9f);
  }
  c.noise(random, 5, 6, 45, 0.8f);
  return c;
}

Canvas rock(Random& random) {
  Canvas c(256, 256, float(random.uniform(110, 160)));
  c.noise(random, 3, 7, 65, 0.75f);
  for (int i = 0; i < 14; ++i)
    c.line(random.uniform(0, 256), random.uniform(0, 256), random.uniform(0, 256), random.uniform(0, 256),
           1.5, 50, 0.6f);
  c.grain(random, 8);
  return c;
}

Canvas clouds(Random& random) {
  Canvas c(512, 512, 0);
  c.noise(random, 2, 8, 1.9f, 0.55f);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) {
      const float cover = 1 / (1 + std::exp(-6 * c.at(x, y)));
      c.at(x, y) = 172 + 72 * cover + 10 * c.at(x, y);
    }
  return c;
}

}  // namespace

std::vector<TextureKind> nature_textures() {
  return {{"bark", 1, 2, bark, Thing::kPole},
          {"crown", 5, 5, crown, Thing::kPlant},
          {"conifer", 4, 8, conifer, Thing::kPlant},
          {"bush", 2.4, 1.2, bush, Thing::kPlant},
          {"reeds", 2.4, 1.2, reeds, Thing::kPlant},
          {"forest", 28, 12, forest, Thing::kPlant},
          {"boulder", 1, 0.5, boulder},
          {"rock", 1, 1, rock},
          {"crown_thin", 5, 5, crown_thin, Thing::kPlant},
          {"crown_bare", 5, 5, crown_bare, Thing::kPlant},
          {"bush_thin", 2.4, 1.2, bush_thin, Thing::kPlant},
          {"bush_bare", 2.4, 1.2, bush_bare, Thing::kPlant},
          {"forest_thin", 28, 12, forest_thin, Thing::kPlant},
          {"forest_bare", 28, 12, forest_bare, Thing::kPlant},
          {"clouds", 1800, 1800, clouds}};
}

}  // namespace edgevo
