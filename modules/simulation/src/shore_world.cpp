// SPDX-License-Identifier: BSD-3-Clause
// A lake shore: water, a bank to the right of the path, reeds, trees and a few houses against a bright sky.
#include <cmath>
#include <tuple>

#include "props.h"
#include "smooth_noise.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kShoreBeyond = 90;  // length of the shore beyond the path on either side, metres

class ShoreBuilder {
 public:
  explicit ShoreBuilder(Site& site)
      : site_(site),
        b_(site.build),
        look_(season_look(site.params.world.season)),
        random_(b_.random()),
        path_(streets_of({site.params.waypoints.front(), site.params.waypoints.back()}, kShoreBeyond,
                         kShoreBeyond, kShoreBeyond)
                  .front()),
        shore_{&path_, -1},
        line_(&random_, 0.03),
        detail_(&random_, 0.15),
        meadow_(&random_, 0.02) {}

  void build() {
    water();
    bank();
    plants();
    for (double s = 30; s < path_.length - 20; s += random_.uniform(35, 60)) {
      const std::string& wall = site_.walls[size_t(random_.below(int(site_.walls.size())))];
      add_house(b_, shore_.place(s, waterline(s) + 16, 1.6), random_.uniform(8, 12), 8, 1 + random_.below(2),
                wall);
    }
    for (double s = 20; s < path_.length; s += random_.uniform(25, 40)) jetty(s);
  }

 private:
  // Distance of the water's edge from the path.
  double waterline(double s) const { return 11 + 1.6 * line_(s) + 0.4 * detail_(s); }

  // Near the boat the water mirrors the sky, towards the bank increasingly the trees.
  void water() {
    constexpr double kBright = 4, kDark = 11, kStep = 0.5;  // metres from the path
    water_strip(-48, kBright, 1.25);
    for (double d = kBright; d < kDark; d += kStep)
      water_strip(d, d + kStep, 1.25 - 0.6 * (d - kBright) / (kDark - kBright));
    water_strip(kDark, 24, 0.65);
  }
  void water_strip(double from, double to, double gain) {
    constexpr double kTile = 12, kLength = 24;  // metres
    const int texture = b_.texture("water", 0);
    for (double s = 0; s < path_.length; s += kLength) {
      const LocalFrame p = shore_.left_end(s, kLength, from, 0);
      Surface& tile = b_.tile(p.point(0, from - to, 0), kLength * p.right, (to - from) * p.out, texture);
      tile.uv_origin = {0, std::ceil(to / kTile) - to / kTile};  // continues from strip to strip
      tile.gain *= look_.water_gain * float(gain);
    }
  }

  // Stones at the water's edge, then grass that rises in three steps of different slope.
  void bank() {
    const double step = 2;
    const char* kinds[] = {"gravel", "grass", "grass", "grass"};
    const double out[] = {-0.6, 1.2, 6, 16, 60}, up[] = {-0.15, 0.45, 1.1, 1.7, 9};
    for (double s = 0; s < path_.length; s += step)
      for (int k = 0; k < 4; ++k) {
        const auto corner = [&](double along, int ring) -> Eigen::Vector3d {
          const Eigen::Vector2d p = shore_.at(along, waterline(along) + out[ring]);
          return {p.x(), p.y(), up[ring]};
        };
        // Seen from the water the right end has the smaller s. Two triangles, as four corners need not be
        // flat.
        const Eigen::Vector3d a = corner(s + step, k + 1), b = corner(s, k + 1), c = corner(s + step, k),
                              d = corner(s, k);
        const float gain = k == 0 ? 1 : look_.grass_gain * float(1.15 + 0.12 * meadow_(s) + 0.06 * k);
        for (const auto& [corner_of, side_u, side_v] :
             {std::tuple{a, b - a, c - a}, std::tuple{d, c - d, b - d}}) {
          Surface& half = b_.tile(corner_of, side_u, side_v, b_.texture(kinds[k], 0));
          half.is_triangle = true;
          half.gain *= gain;
        }
      }
    for (double s = 0; s < path_.length; s += random_.uniform(0.4, 2.2)) {
      const double width = random_.uniform(0.4, 1.7);
      b_.card(shore_.place(s, waterline(s) + random_.uniform(-0.6, 0.9), -0.12), width,
              width * random_.uniform(0.35, 0.6), random_.uniform(-0.3, 0.3), b_.any_texture("boulder", 6),
              float(random_.uniform(0.8, 1.15)));
    }
  }

  void plants() {
    const double density = std::max(0.05, site_.params.world.density);
    for (double s = 1; s < path_.length; s += random_.uniform(0.5, 2.6) / density)
      b_.card(shore_.place(s, waterline(s) + random_.uniform(-0.9, 0.6), -0.05), random_.uniform(1.2, 2.6),
              random_.uniform(0.6, 1.4), random_.uniform(-0.5, 0.5), b_.any_texture("reeds", 6),
              look_.reed_gain * float(random_.uniform(0.8, 1.2)));
    for (double s = 1; s < path_.length; s += random_.uniform(2, 6) / density)
      add_bush(b_, shore_.place(s, waterline(s) + random_.uniform(1.5, 6), 0.7), random_.uniform(1.2, 3.2),
               look_.leaves);
    for (double s = 1; s < path_.length; s += random_.uniform(3, 7) / density)
      tree(s, random_.uniform(3, 14), 1.0);
    for (double s = 1; s < path_.length; s += random_.uniform(3, 6) / density)
      tree(s, random_.uniform(26, 50), 3.0);
    for (double s = 1; s < path_.length; s += random_.uniform(1, 3) / density) {  // undergrowth up the slope
      const double beyond = random_.uniform(16, 48);
      add_bush(b_, shore_.place(s, waterline(s) + beyond, height_of_meadow(beyond) - 0.1),
               random_.uniform(1.2, 3.5), look_.leaves);
    }
    for (double beyond : {60.0, 56.0})  // the wood on the ridge
      for (double s = -10; s < path_.length + 10; s += random_.uniform(12, 17))
        b_.card(shore_.place(s, waterline(s) + beyond, height_of_meadow(beyond) - 1.2), 28,
                random_.uniform(9, 13), random_.uniform(-0.1, 0.1),
                b_.any_texture("forest" + look_.leaves.suffix(), 5),
                look_.leaves.gain * float(random_.uniform(0.85, 1.1)));
  }
  // The last step of the bank, over the water.
  static double height_of_meadow(double beyond_water) { return 1.7 + (beyond_water - 16) / 44 * 7.3; }
  void tree(double s, double beyond_water, double foot) {
    const LocalFrame place = shore_.place(s, waterline(s) + beyond_water, foot - 0.3);
    if (random_.uniform() < 0.35)
      add_conifer(b_, place, random_.uniform(7, 14));
    else
      add_tree(b_, place, random_.uniform(5, 11), look_.leaves);
  }

  void jetty(double s) {
    const int wood = b_.texture("wood", 0);
    const LocalFrame place = shore_.place(s, waterline(s) + 0.8);
    b_.box(place, {-0.7, 0.7, -0.5, 4.2, 0.4, 0.5}, wood, wood, -1, true, 0.9f);
    for (double o = 0.6; o < 4.3; o += 1.7)
      for (double r : {-0.65, 0.65}) b_.prism(place.moved(r, o, -0.2), 0.09, 1.2, 7, b_.texture("bark", 0));
  }

  Site& site_;
  WorldBuilder& b_;
  const SeasonLook& look_;
  Random& random_;
  Street path_;
  Side shore_;
  SmoothNoise line_, detail_, meadow_;
};

}  // namespace

void build_lakeshore(Site& site) { ShoreBuilder(site).build(); }

}  // namespace edgevo
